# SPDX-License-Identifier: GPL-3.0-or-later
"""One run of the engine: the parts of an atlas, who of them takes part, and the keywords."""

from dataclasses import dataclass, replace

import numpy as np

from .density import Density, pixels_per_metre, surface_area, uv_area
from .joined import Joined, corners_of
from .who import group_faces, groups_without_work, stay


class NothingToDoError(Exception):
    """The message says why."""


@dataclass(frozen=True)
class Request:
    joined: Joined
    arguments: dict  # of atlas_refine.start()

    @property
    def face_count(self):
        return int(self.joined.first_faces[-1])

    @property
    def box_count(self):
        """Textures and tiles."""
        return len(self.arguments.get("group_names", ("",)))

    def boxes(self):
        """(name, the four array arguments) of each texture or tile by itself, moved to the first tile."""
        positions, offsets, vertices, uvs = self.joined.arrays()
        groups = self.arguments.get("groups")
        if groups is None:
            yield "", (positions, offsets, vertices, uvs)
            return
        for group, (name, origin) in enumerate(zip(self.arguments["group_names"], self.arguments["group_origins"], strict=True)):
            faces = np.flatnonzero(groups == group)
            corners = corners_of(offsets, faces)
            own_offsets = np.concatenate([[0], np.cumsum(np.diff(offsets)[faces])])
            yield name, (positions, own_offsets, vertices[corners], uvs[corners] - origin)

    def density(self, options, texture, metres, result=None):
        """The Density of the atlas as it is and as the result has it; `metres`: in a unit of Blender."""
        positions, offsets, vertices, uvs = self.joined.arrays()
        area, size = surface_area(positions, offsets, vertices), options.texture_pixels(texture)
        metres *= self.joined.unit
        density = Density(
            size,
            pixels_per_metre(uv_area(offsets, uvs), size, area, metres),
            wanted=options.wanted_density,
            is_free="uv_density" in self.arguments,
            of_image=options.takes_image(texture),
        )
        if result is None:
            return density
        after = uv_area(offsets if result.cut is None else result.cut.face_offsets, result.corner_uvs)
        box = tuple(side * pixels for side, pixels in zip((result.after.box_width, result.after.box_height), size, strict=True))
        return replace(density, after=pixels_per_metre(after, size, area, metres), box_px=box)

    @property
    def reaches_beyond(self):
        """Some chart lies beside the one texture that all share."""
        uvs = self.joined.arrays()[3]
        return "groups" not in self.arguments and not np.all((uvs >= 0) & (uvs <= 1) | np.isnan(uvs))

    @property
    def leaves_faces_out(self):
        return not all(part.taken.all() for part in self.joined.parts)


def prepare(engine, parts, options, texture=None, tile=(0, 0), material_names=(), metres=1.0):
    """`engine`: the atlas_refine module; `tile`: the active one; `metres`: in a unit of Blender. Sets Part.taken.

    Raises NothingToDoError."""
    locked = [_choose(engine, part, options) for part in parts]
    _require_work(parts, locked, _why_nothing(parts))
    of_faces, corners, tile_names = _tiles(engine, parts, options, texture, tile)
    _require_work(parts, locked, "no chart that may be moved lies in the active tile")
    by_material = options.atlases == "MATERIAL"
    materials = np.concatenate([part.materials[part.taken] if by_material else 0 * part.materials[part.taken] for part in parts])
    codes = np.column_stack([materials, of_faces])
    groups, first = group_faces(codes)
    idle = groups_without_work(groups, Joined(parts).of_faces(locked))
    if idle.any():
        _leave_out(parts, idle)
        codes = codes[~idle]
        groups, first = group_faces(codes)
    joined = Joined(parts)
    arguments = {**options.engine_arguments(texture), **_arguments_of(joined, locked)}
    if "locked" in arguments and options.aspect == "FREE":  # what stays where it is, is somewhere in a texture
        arguments.update(box_aspect=1.0, in_texture=True)
    if options.wanted_density > 0 and not arguments["in_texture"]:
        arguments["uv_density"] = options.wanted_density * metres * joined.unit / options.pixels(texture)
    origins = corners[codes[first, 1]]
    if len(first) > 1 or np.any(origins):
        labels = [name or "no material" for name in material_names] if by_material else [""]
        names = [" ".join(filter(None, (labels[material], tile_names[at]))) for material, at in codes[first]]
        arguments.update(groups=groups, group_origins=origins, group_names=names)
    return Request(joined, arguments)


def _choose(engine, part, options):
    """Sets Part.taken and returns the locked faces."""
    if not part.hidden.any() and part.selected.all() and not part.pinned.any():
        return np.zeros(len(part.hidden), dtype=bool)
    groups = part.materials if options.atlases == "MATERIAL" else None
    charts = engine.charts_of_faces(*part.atlas.as_tuple(), groups=groups, name=part.name)
    left_out, locked = stay(charts, part.hidden, part.selected, part.pinned)
    part.taken = ~left_out
    return locked


def _why_nothing(parts):
    if not any(len(part.hidden) for part in parts):
        return "the mesh has no faces"
    if all(part.hidden.all() for part in parts):
        return "all faces are hidden"
    if not any(np.any(part.selected & ~part.hidden) for part in parts):
        return "no chart is selected: select those that are to be refined"
    return "every chart that is selected is pinned or partly hidden, and stays"


def _require_work(parts, locked, why):
    if not any(np.any(part.taken & ~flags) for part, flags in zip(parts, locked, strict=True)):
        raise NothingToDoError(why)


def _tiles(engine, parts, options, texture, tile):
    """(tile of each taken face, lower left corners, names); with ACTIVE only its faces are taken from here on."""
    wanted = options.tiles_of(texture)
    joined = Joined(parts)
    if wanted == "ONE":
        return np.zeros(joined.first_faces[-1], dtype=np.int32), np.zeros((1, 2)), [""]
    tiles, corners, names = engine.group_by_tile(*joined.arrays())
    if wanted == "ACTIVE":
        others = ~np.all(corners[tiles] == tile, axis=1)
        _leave_out(parts, others)
        tiles = tiles[~others]
    return tiles, corners, names


def _leave_out(parts, flags):
    """Takes the flagged ones of the taken faces out."""
    first = 0
    for part in parts:
        taken = np.flatnonzero(part.taken)
        part.taken[taken[flags[first : first + len(taken)]]] = False
        first += len(taken)


def _arguments_of(joined, locked):
    arguments = {
        "triangles": joined.triangles(),
        "no_seam": joined.edges("no_seam"),
        "prefer_seam": joined.edges("prefer_seam"),
        "keep_shape": joined.values("keep_shape", False),
        "importance": joined.values("importance", 1.0),
    }
    if any(flags.any() for flags in locked):
        arguments["locked"] = joined.of_faces(locked)
    return arguments
