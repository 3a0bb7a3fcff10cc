# SPDX-License-Identifier: GPL-3.0-or-later
"""One run of the engine: the parts of an atlas, who of them takes part, and the keywords."""

from dataclasses import dataclass, replace

import numpy as np

from .canvas import Canvas, beside_active_tiles, missing_tiles, places_of
from .density import Density, pixels_per_metre, surface_areas, uv_areas
from .joined import Joined, corners_of, renumbered
from .who import group_faces, groups_without_work, stay

ONE_CANVAS = (Canvas(),)


class NothingToDoError(Exception):
    """The message says why."""


@dataclass(frozen=True)
class Request:
    joined: Joined
    arguments: dict  # of atlas_refine.start()
    textures: tuple  # of each box: a texture, or one of its tiles
    notes: tuple = ()

    @property
    def face_count(self):
        return int(self.joined.first_faces[-1])

    @property
    def box_names(self):
        return self.arguments.get("group_names", [""])

    @property
    def box_aspects(self):
        return self.arguments.get("group_aspects", [self.arguments["box_aspect"]] * len(self.box_names))

    @property
    def _groups(self):
        return self.arguments.get("groups", np.zeros(self.face_count, dtype=np.int32))

    def boxes(self):
        """(name, the four array arguments, the triangles of its larger faces, the aspect) of each box by itself, moved to the first
        tile; without the faces that a refinement leaves out because they have corners that are no numbers."""
        positions, offsets, vertices, uvs = self.joined.arrays()
        finite = _finite_faces(positions, offsets, vertices, uvs)
        triangles = self.arguments["triangles"]
        if "groups" not in self.arguments and finite.all():
            yield "", (positions, offsets, vertices, uvs), triangles, self.box_aspects[0]
            return
        positions = np.where(np.isfinite(positions), positions, 0)
        origins = self.arguments.get("group_origins", np.zeros((1, 2)))
        for group, (name, origin, aspect) in enumerate(zip(self.box_names, origins, self.box_aspects, strict=True)):
            faces = np.flatnonzero((self._groups == group) & finite)
            corners = corners_of(offsets, faces)
            own_offsets = np.concatenate([[0], np.cumsum(np.diff(offsets)[faces])])
            arrays = positions, own_offsets, vertices[corners], uvs[corners] - origin
            yield name, arrays, renumbered(triangles, corners, len(uvs)), aspect

    def densities(self, options, metres, result=None):
        """The Density of each box as it is and as the result has it; `metres`: in a unit of Blender."""
        is_free = "uv_density" in self.arguments and not self.arguments["in_texture"]
        positions, offsets, vertices, uvs = self.joined.arrays()
        metres *= self.joined.unit
        areas = self._in_boxes(surface_areas(positions, offsets, vertices))
        before = self._in_boxes(uv_areas(offsets, uvs))
        after, boxes = (before, None) if result is None else self._after(result)
        for k, texture in enumerate(self.textures):
            size = options.texture_pixels(texture)
            density = Density(
                size,
                pixels_per_metre(before[k], size, areas[k], metres),
                wanted=options.wanted_density,
                is_free=is_free,
                of_image=options.takes_image(texture),
            )
            if result is not None:
                density = replace(density, after=pixels_per_metre(after[k], size, areas[k], metres))
                if k in boxes:
                    box = boxes[k].box_width * size[0], boxes[k].box_height * size[1]
                    share = boxes[k].pe_fixed_aspect  # 0 where all charts lie beside the texture
                    spare = max(1.0, options.pe_bound / share) if share > 0 else 1.0
                    density = replace(density, box_px=box, spare=spare)
            yield density

    def _in_boxes(self, values, groups=None):
        """Sums of one value per face."""
        return np.bincount(self._groups if groups is None else groups, weights=values, minlength=len(self.box_names))

    def _after(self, result):
        """(UV area of each box, {box: its measures})."""
        if result.cut is None:
            areas = self._in_boxes(uv_areas(self.joined.arrays()[1], result.corner_uvs))
        else:
            areas = self._in_boxes(uv_areas(result.cut.face_offsets, result.corner_uvs), self._groups[result.cut.face_sources])
        return areas, {group.group: group.after for group in result.groups} or {0: result.after}

    @property
    def reaches_beyond(self):
        """Some chart lies beside the one texture that all share."""
        uvs = self.joined.arrays()[3]
        return "groups" not in self.arguments and not np.all((uvs >= 0) & (uvs <= 1) | np.isnan(uvs))

    @property
    def leaves_faces_out(self):
        return not all(part.taken.all() for part in self.joined.parts)


def _finite_faces(positions, offsets, vertices, uvs):
    finite = np.isfinite(uvs).all(axis=1) & np.isfinite(positions).all(axis=1)[vertices]
    return np.logical_and.reduceat(finite, offsets[:-1])


def prepare(engine, parts, options, canvases=ONE_CANVAS, metres=1.0, moves=True):
    """`engine`: the atlas_refine module; `canvases`: of each material where each has a texture of its own, else the one of all;
    `metres`: in a unit of Blender; `moves`: charts are to be moved; else it is no matter that all of them stay. Sets Part.taken.

    Raises NothingToDoError."""
    if not any(part.atlas.has_uvs for part in parts):
        raise NothingToDoError(_why_nothing(parts))
    locked = [_choose(engine, part, options) for part in parts]
    staying = locked if moves else [np.zeros_like(flags) for flags in locked]
    _require_work(parts, staying, _why_nothing(parts))
    places = places_of(engine, parts, options, canvases)
    if options.tiles == "ACTIVE":
        places = _leave_out(parts, places, beside_active_tiles(places, canvases))
    _require_work(parts, staying, "no chart that may be moved lies in the active tile")
    groups, first = group_faces(places.codes)
    idle = groups_without_work(groups, Joined(parts).of_faces(staying))
    if idle.any():
        places = _leave_out(parts, places, idle)
        groups, first = group_faces(places.codes)
    joined = Joined(parts)
    used = [(canvases[canvas], tile) for canvas, tile in places.codes[first]]
    textures = tuple(canvas.texture for canvas, _ in used)
    arguments = {**options.engine_arguments(textures[0]), **_arguments_of(joined, locked)}
    if options.stacks == "KEEP" and len(numbers := _stack_groups(joined, options)) > 0:
        arguments["stack_groups"] = numbers
    if "locked" in arguments and options.aspect == "FREE":  # what stays where it is, is somewhere in a texture
        arguments.update(box_aspect=1.0, in_texture=True)
    densities = _without_locked(options.uv_densities(textures, metres * joined.unit), groups, arguments.get("locked"))
    if any(densities):
        arguments["uv_density"] = max(densities)
    origins = places.corners[places.codes[first, 1]]
    if len(first) > 1 or np.any(origins):
        names = [" ".join(filter(None, (canvas.name, places.names[tile]))) for canvas, tile in used]
        arguments.update(groups=groups, group_origins=origins, group_names=names, **options.arguments_of_groups(textures))
        if "uv_density" in arguments and len(set(densities)) > 1:
            arguments["group_densities"] = densities
    return Request(joined, arguments, textures, tuple(missing_tiles(places, canvases)))


def _choose(engine, part, options):
    """Sets Part.taken and returns the locked faces."""
    if not part.hidden.any() and part.selected.all() and not part.pinned.any():
        return np.zeros(len(part.hidden), dtype=bool)
    groups = part.materials if options.atlases == "MATERIAL" else None
    charts = engine.charts_of_faces(*part.atlas.as_tuple(), groups=groups, name=part.name)
    left_out, locked = stay(charts, part.hidden, part.selected, part.pinned)
    part.taken = ~left_out
    return locked


def _stack_groups(joined, options):
    """A number for each face, where there are several: charts lie on each other on purpose where they show one texture, in one size
    where that is asked for."""
    scales = [np.full(len(part.taken), round(part.scale if options.density != "KEEP" else 1.0, 3)) for part in joined.parts]
    keys = np.stack([joined.of_faces([part.materials for part in joined.parts]), joined.of_faces(scales)])
    kinds, numbers = np.unique(keys, axis=1, return_inverse=True)
    return numbers.ravel() if kinds.shape[1] > 1 else []


def _without_locked(densities, groups, locked):
    """0 for boxes in which charts stay: they have the density that they have."""
    held = set() if locked is None else set(groups[locked].tolist())
    return [0.0 if group in held else density for group, density in enumerate(densities)]


def _why_nothing(parts):
    if not any(len(part.hidden) for part in parts):
        return "the mesh has no faces"
    if not any(part.atlas.has_uvs for part in parts):
        return "no face has UVs: unwrap the mesh"
    if all(part.hidden.all() for part in parts):
        return "all faces are hidden"
    if not any(np.any(part.selected & ~part.hidden) for part in parts):
        return "no chart is selected: select those that are to be refined"
    return "every chart that is selected is pinned or partly hidden, and stays"


def _require_work(parts, locked, why):
    if not any(np.any(part.taken & ~flags) for part, flags in zip(parts, locked, strict=True)):
        raise NothingToDoError(why)


def _leave_out(parts, places, flags):
    """Takes the flagged ones of the taken faces out. Returns the places of the others."""
    first = 0
    for part in parts:
        taken = np.flatnonzero(part.taken)
        part.taken[taken[flags[first : first + len(taken)]]] = False
        first += len(taken)
    return places.without(flags)


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
