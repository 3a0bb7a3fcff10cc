# SPDX-License-Identifier: GPL-3.0-or-later
"""One atlas: its meshes are read, the engine runs, what comes of it is written. What takes long is done in steps (core/steps.py)."""

from contextlib import ExitStack
from dataclasses import dataclass, replace

import bpy
import numpy as np

from . import engine
from .bridge import cuts
from .bridge import mesh as bridge
from .bridge import parts as objects
from .bridge.named import why_not_painted
from .bridge.texture import find_canvases, other_images
from .core.atlas import stored_uvs
from .core.cuts import plan_cut, seam_edges
from .core.density import notes_on_unequal, too_small
from .core.notes import joined, notes, objects_of_charts
from .core.request import prepare
from .core.steps import to_its_end
from .core.summary import Asked, headline, measured, missed
from .core.words import counted, titled

#: From so many times as dense as another on a chart has another density: what the engine tells of charts, too.
UNEQUAL = 1.1


@dataclass(frozen=True)
class Done:
    """A result, or measures, that the panel shows."""

    title: str
    face_count: int
    is_free: bool
    reached_beyond: bool  # charts lay beside the texture
    asked: Asked
    result: object = None
    measures: object = None
    hidden: int = 0  # faces that were not measured
    densities: tuple = ()  # (name of the texture or tile, core.density.Density)
    notes: tuple = ()
    mended: tuple = ()  # what the engine says besides its figures, one line each
    left: tuple = ()  # (object's name, faces) of charts that were left as they are
    new_seams: tuple = ()  # (object's name, (S, 2) vertices) of edges that were cut
    prints: tuple = ()  # (object's name, UV map, fingerprint) of what it is true of

    @property
    def headline(self):
        if self.result is None:
            return measured(self.measures, self.is_free, self.reached_beyond, self.hidden, self.asked)
        return headline(self.result, self.is_free, self.reached_beyond, self.asked)

    @property
    def told(self):
        """What a script should know, one line each; the panel tells of densities, and of what was missed, elsewhere."""
        sizes = [titled(name, too_small(density)) for name, density in self.densities if density.is_too_small]
        return (*(f"missed: {text}" for text in missed(self.result, self.asked)), *self.notes, *sizes)


class Atlas:
    """One run of the engine. Holds names, not Blender's data: undo may replace that meanwhile."""

    def __init__(self, options, objs):
        self.options = options
        self.title = objs[0].name if len(objs) == 1 else counted(len(objs), "object")
        self.job = None

    def read(self, context, objs, moves=True):
        """In steps. Raises one of tasks.FAILURES where the objects cannot be refined so."""
        options, material_numbers = self.options, {}
        self.metres = context.scene.unit_settings.scale_length
        self.parts = []
        for obj in objs:
            needs_room = moves and options.write_to == "COPY"
            self.parts.append((yield from _read(context, obj, options, material_numbers, needs_room)))
        _require_names(self.parts, objs, options)
        materials = list(material_numbers)
        self.material_count = len(materials)
        canvases = find_canvases(context, objs, materials, options.atlases)
        self.request = yield lambda: prepare(engine.module, self.parts, options, canvases, self.metres, moves)
        if options.seams != "NONE" and options.cut == "SPLIT":
            for obj in objs:
                cuts.check_divisible(obj)
            if self.request.leaves_faces_out:
                raise bridge.MeshError("cuts across faces need all charts of the mesh: show all, or cut along edges")
        pairs = [(obj.name, note) for obj in objs for note in _notes(obj)]
        on_objects = joined(pairs) if len(objs) > 1 else [note for _, note in pairs]
        self.notes = [*on_objects, *self.request.notes, *self._notes_on_images(materials)]
        self.notes += options.notes_on_margins(self.request.textures)
        if options.density == "KEEP" and len(self.request.box_names) == 1:
            self.notes += yield lambda: list(notes_on_unequal(self.parts))

    def _notes_on_images(self, materials):
        texture = self.request.textures[0]
        if self.options.atlases == "MATERIAL" or texture is None:
            return
        used = {materials[number] for part in self.parts for number in np.unique(part.materials[part.taken])}
        alike, of_another_shape = other_images(texture, used)
        if of_another_shape and self.options.takes_image(texture):
            yield f"packed for {texture.name}; of another shape: {', '.join(of_another_shape)}. By Material each has its own"
        elif alike:
            yield f"{texture.name} and {', '.join(alike)} share one atlas, so each is used in part only. By Material each has its own"

    def holds_unequal_densities(self):
        """Whether the run ended where it began, as the use was there, though charts have other densities than the one for all that was
        asked for."""
        if self.options.density != "EQUAL" or self.request.arguments["relax"]:
            return False
        try:
            result = self.job.result()
        except engine.AtlasRefineError:
            return False
        densities = [chart.density_after for chart in result.charts if chart.fate == "refined"]
        return result.intervention == "unchanged" and bool(densities) and max(densities) > UNEQUAL * min(densities)

    def start_for_equal_densities(self, threads, keywords):
        """Anew, though the use is there."""
        self.request.arguments["relax"] = True
        self.start(threads, keywords)

    def start(self, threads, keywords):
        name = self.title if len(self.parts) == 1 else ""
        self.job = engine.start(*self.request.joined.arrays(), name=name, threads=threads, **self.request.arguments, **keywords)

    def write(self, result, is_alone):
        """In steps, between which nothing may change the meshes. Raises one of tasks.FAILURES with all of them as they were.

        `is_alone`: nothing else could run since they were read, so that they are not read again."""
        objs = []
        for part in self.parts:
            objs.append(bpy.data.objects[part.name] if is_alone else (yield from _still_there(part)))
        if result.intervention == "unchanged":
            return (yield lambda: self._done(result, self.prints()))
        uvs = yield lambda: stored_uvs(result.corner_uvs)
        write = self._write_uvs if result.cut is None else self._write_cut
        with ExitStack() as on_failure:
            maps = [self._target(obj, part, on_failure) for obj, part in zip(objs, self.parts, strict=True)]
            seams, prints = yield from write(objs, maps, result, uvs, on_failure)
            on_failure.pop_all()
        return (yield lambda: self._done(result, prints, seams))

    def _target(self, obj, part, on_failure):
        """The name of the UV map that is to be written."""
        if self.options.write_to != "COPY":
            return part.uv_map
        copied, before = bridge.add_copy(obj, part.uv_map)
        on_failure.callback(bridge.remove_copy, obj, copied, before)
        return copied

    def _write_uvs(self, objs, maps, result, uvs, on_failure):
        seams, written, prints = yield lambda: self._planned(result, uvs, maps)
        for part, obj, uv_map, atlas in zip(self.parts, objs, maps, written, strict=True):
            on_failure.callback(bridge.write_uvs, obj, uv_map, part.atlas.corner_uvs)
            yield from bridge.write_in_steps(obj, uv_map, atlas.corner_uvs)
        if self.options.mark_seams:
            for obj, edges in zip(objs, seams, strict=True):
                bridge.mark_seams(obj, edges)
        return seams, prints

    def _planned(self, result, uvs, maps):
        """(new seams of each part, its arrays once it is written, by which they are known again)."""
        joined = self.request.joined
        seams = [seam_edges(part.atlas, joined.seams_of(k, result.new_seams)) for k, part in enumerate(self.parts)]
        written = [replace(part.atlas, corner_uvs=joined.uvs_of(k, uvs)) for k, part in enumerate(self.parts)]
        return seams, written, self._prints_of(maps, [atlas.fingerprint() for atlas in written])

    def _write_cut(self, objs, maps, result, uvs, on_failure):
        """What can fail is done for every object before the first is divided: divided faces are not put together again."""
        plans, divisions = [], []
        for k, (obj, uv_map) in enumerate(zip(objs, maps, strict=True)):
            cuts.check_divisible(obj)  # again: its mode may be another by now
            plans.append((yield lambda k=k: plan_cut(self.parts[k].atlas, *self.request.joined.cut_of(k, result.cut, uvs))))
            divisions += yield from cuts.rehearse_cut(obj, uv_map, plans[k], self.options.mark_seams)
        for part, obj, uv_map, plan in zip(self.parts, objs, maps, plans, strict=True):
            on_failure.callback(bridge.write_uvs, obj, uv_map, part.atlas.corner_uvs)
            yield from cuts.write_before_division(obj, uv_map, plan)
        on_failure.pop_all()
        yield from to_its_end(divisions)
        prints = []
        for obj, uv_map in zip(objs, maps, strict=True):
            atlas = yield from bridge.read_in_steps(obj, uv_map)
            prints.append((yield atlas.fingerprint))
        return [plan.new_seams for plan in plans], self._prints_of(maps, prints)

    def _done(self, result, prints, seams=()):
        new_seams = tuple(zip((part.name for part in self.parts), seams, strict=False))
        densities = tuple(self._densities(result))
        found = {"mended": self.mended(result), "left": self._left(result), "new_seams": new_seams}
        return self._shown(prints, self.title, densities=densities, result=result, **found)

    def title_of(self, error):
        """With the object whose face is at fault."""
        face = getattr(error, "face", -1)
        if len(self.parts) == 1 or face < 0:
            return self.title
        return f"{self.title}, {self.parts[np.searchsorted(self.request.joined.first_faces, face, side='right') - 1].name}"

    def words_of(self, message):
        """The engine's message, which knows parts of a texture, in pixels."""
        size = min(map(self.options.pixels, self.request.textures))
        told = f"the margin of {self.options.gap_px:g} px is more than a tenth of the texture of {size} px"
        return message.replace("the gap must lie in [0, 0.1] of the box", told)

    def mended(self, result):
        """What the engine says besides its figures, one line each."""
        if len(self.parts) == 1:
            return tuple(notes(result))
        names = [part.name for part in self.parts]
        return tuple(notes(result, objects_of_charts(result.face_charts, self.request.joined.first_faces[:-1], names)))

    def prints(self):
        """By which the meshes are known again, as they were read."""
        return self._prints_of([part.uv_map for part in self.parts], [part.atlas.fingerprint() for part in self.parts])

    def _prints_of(self, maps, fingerprints):
        return tuple(zip((part.name for part in self.parts), maps, fingerprints, strict=True))

    def _left(self, result):
        """Nothing where faces were divided: their numbers are others now."""
        if result.cut is not None:
            return ()
        left = np.array([chart.fate == "left" for chart in result.charts])[result.face_charts]
        return tuple((part.name, self.request.joined.faces_of(k, left)) for k, part in enumerate(self.parts))

    def measure(self):
        """What the panel shows of the meshes as they are: a Done for each texture or tile."""
        prints = self.prints()
        densities = list(self._densities())
        hidden = sum(int(np.sum(part.hidden & ~part.taken)) for part in self.parts)
        in_texture = self.request.arguments["in_texture"]
        for (name, arrays, triangles, aspect), density in zip(self.request.boxes(), densities, strict=True):
            if len(arrays[1]) == 1:  # all its faces were left out
                continue
            measures = engine.measure(*arrays, box_aspect=aspect, in_texture=in_texture, triangles=triangles)
            title = ", ".join(filter(None, (self.title, name)))
            yield self._shown(prints, title, densities=(("", density[1]),), measures=measures, hidden=hidden)
            hidden = 0  # told once

    def _shown(self, prints, title, **found):
        request = self.request
        is_free = not request.arguments["in_texture"]
        beyond = request.reaches_beyond and not is_free
        fixed = (title, request.face_count, is_free, beyond, self._asked())
        return Done(*fixed, notes=tuple(self.notes), prints=prints, **found)

    def _asked(self):
        """With a density in pixels per metre the use is no more than what charts may come to."""
        options, boxes = self.options, "tile"
        if options.atlases == "MATERIAL":
            boxes = "material" if len(self.request.box_names) <= self.material_count else "texture"
        use = options.pe_bound if options.density != "VALUE" else 0.0
        return Asked(use, options.max_distortion, options.max_stretch, boxes)

    def _densities(self, result=None):
        return zip(self.request.box_names, self.request.densities(self.options, self.metres, result), strict=True)


def _still_there(part):
    """The object, in steps, where it still holds what was read."""
    obj = bpy.data.objects.get(part.name) or objects.object_of_mesh(part.mesh_name)
    if obj is None or obj.type != "MESH":
        raise bridge.MeshError(f"{part.name}: it is gone; nothing was written")
    part.name = obj.name  # it may have been renamed
    if part.uv_map in obj.data.uv_layers:
        atlas = yield from bridge.read_in_steps(obj, part.uv_map)
        if (yield lambda: atlas.same_as(part.atlas)):
            return obj
    raise bridge.MeshError("the mesh was changed meanwhile; nothing was written")


def _read(context, obj, options, material_numbers, needs_room):
    try:
        if needs_room:
            bridge.check_room_for_copy(obj)
        return (yield from objects.read_part(context, obj, options, material_numbers))
    except bridge.MeshError as error:
        raise bridge.MeshError(f"{obj.name}: {error}") from error


def _require_names(parts, objs, options):
    for option in ("keep_shape", "importance", "no_seam", "prefer_seam"):
        name = getattr(options, option)
        if not name or any(getattr(part, option) is not None for part in parts):
            continue
        is_of_edges = option.endswith("seam")
        others = filter(None, (why_not_painted(obj, name, "EDGE" if is_of_edges else "FACE") for obj in objs))
        if other := next(others, ""):
            needed = "an edge attribute" if is_of_edges else "a vertex group or a face attribute"
            raise bridge.MeshError(f"{other}: {needed} of numbers is needed")
        raise bridge.MeshError(
            f'there is no {"edge attribute" if is_of_edges else "vertex group and no face attribute"} "{name}"'
        )


def _notes(obj):
    users = objects.users_of(obj.data)
    if users > 1:
        yield f"{users} objects share the mesh, and all of them change"
    if bridge.has_uneven_scale(obj):
        yield "the object's scale is uneven; the UVs follow the mesh without it"


def print_of(object_name, uv_map):
    """Of all that a result is true of; None where it is gone."""
    obj = bpy.data.objects.get(object_name)
    if obj is None or obj.type != "MESH" or uv_map not in obj.data.uv_layers:
        return None
    return bridge.read_atlas(obj, uv_map).fingerprint()
