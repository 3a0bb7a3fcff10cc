# SPDX-License-Identifier: GPL-3.0-or-later
"""One call of the operator: read the meshes, run the engine beside Blender, write what comes. At most one runs with a window's progress."""

import os
from contextlib import ExitStack
from dataclasses import dataclass, replace

import bpy
import numpy as np

from . import drawing, engine, preferences
from .bridge import cuts
from .bridge import mesh as bridge
from .bridge import parts as objects
from .bridge.texture import active_tile, find_texture, of_another_shape
from .changes import Watch, no_longer, once_drawn
from .core.atlas import stored_uvs
from .core.cuts import plan_cut, seam_edges
from .core.density import too_small
from .core.request import NothingToDoError, prepare
from .core.words import counted

#: What a run may fail with for reasons that lie in the objects or the options.
FAILURES = (engine.AtlasRefineError, bridge.MeshError, NothingToDoError, ValueError)

#: The run whose progress the panel shows.
running = None
#: What the panel shows: the Done of the last run or measure, None where there is none or it is no longer true.
last = None
_in_doubt = False


@dataclass(frozen=True)
class Done:
    """A result, or measures, that the panel shows."""

    title: str
    face_count: int
    is_free: bool
    reached_beyond: bool  # charts lay beside the texture
    max_distortion: float  # that was asked for; 0: none
    result: object = None
    measures: object = None
    density: object = None  # core.density.Density
    notes: tuple = ()
    left: tuple = ()  # (object's name, faces) of charts that were left as they are
    new_seams: tuple = ()  # (object's name, (S, 2) vertices) of edges that were cut
    prints: tuple = ()  # (object's name, UV map, fingerprint) of what it is true of

    @property
    def told(self):
        """What a script should know, one line each; the panel tells of densities elsewhere."""
        return tuple(filter(None, (*self.notes, too_small(self.density))))


class Atlas:
    """One run of the engine. Holds names, not Blender's data: undo may replace that meanwhile."""

    def __init__(self, context, objs, options):
        self.options = options
        material_numbers = {}
        self.parts = [_read(context, obj, options, material_numbers) for obj in objs]
        self.title = _title(objs)
        _require_names(self.parts, options)
        self.texture = find_texture(context, objs[0])
        tile = active_tile(context, self.texture)
        self.metres = context.scene.unit_settings.scale_length
        self.request = prepare(engine.module, self.parts, options, self.texture, tile, list(material_numbers), self.metres)
        if options.seams != "NONE" and options.cut == "SPLIT":
            for obj in objs:
                cuts.check_divisible(obj)
            if self.request.leaves_faces_out:
                raise bridge.MeshError("cuts across faces need all charts of the mesh: show all, or cut along edges")
        self.notes = [*(note for obj in objs for note in _notes(obj)), *self._notes_on_images(list(material_numbers))]
        self.job = None

    def _notes_on_images(self, materials):
        if not self.options.takes_image(self.texture):
            return
        used = {materials[number] for part in self.parts for number in np.unique(part.materials[part.taken])}
        others = of_another_shape(self.texture, used)
        if others:
            yield f"packed for {self.texture.name}; of another shape: {', '.join(others)}. Select the charts of one image at a time"

    def start(self, threads, keywords):
        name = self.title if len(self.parts) == 1 else ""
        self.job = engine.start(*self.request.joined.arrays(), name=name, threads=threads, **self.request.arguments, **keywords)

    def write(self, result):
        """Writes the result, or raises one of FAILURES with all meshes as they were."""
        objs = [self._still_there(part) for part in self.parts]
        if result.intervention == "unchanged":
            return self._done(result, self.prints())
        uvs = stored_uvs(result.corner_uvs)
        write = self._write_uvs if result.cut is None else self._write_cut
        with ExitStack() as on_failure:
            maps = [self._target(obj, part, on_failure) for obj, part in zip(objs, self.parts, strict=True)]
            seams, prints = write(objs, maps, result, uvs, on_failure)
            on_failure.pop_all()
        return self._done(result, prints, seams)

    def _still_there(self, part):
        obj = bpy.data.objects.get(part.name)
        if obj is None or obj.type != "MESH":
            raise bridge.MeshError(f"{part.name} is gone; nothing was written")
        if part.uv_map not in obj.data.uv_layers or not bridge.read_atlas(obj, part.uv_map).same_as(part.atlas):
            raise bridge.MeshError("the mesh was changed meanwhile; nothing was written")
        return obj

    def _target(self, obj, part, on_failure):
        """The name of the UV map that is to be written."""
        if self.options.write_to != "COPY":
            return part.uv_map
        copied, before = bridge.add_copy(obj, part.uv_map)
        on_failure.callback(bridge.remove_copy, obj, copied, before)
        return copied

    def _write_uvs(self, objs, maps, result, uvs, on_failure):
        joined = self.request.joined
        seams = [seam_edges(part.atlas, joined.seams_of(k, result.new_seams)) for k, part in enumerate(self.parts)]
        written = [replace(part.atlas, corner_uvs=joined.uvs_of(k, uvs)) for k, part in enumerate(self.parts)]
        for part, obj, uv_map, atlas in zip(self.parts, objs, maps, written, strict=True):
            on_failure.callback(bridge.write_uvs, obj, uv_map, part.atlas.corner_uvs)
            bridge.write_uvs(obj, uv_map, atlas.corner_uvs)
        if self.options.mark_seams:
            for obj, edges in zip(objs, seams, strict=True):
                bridge.mark_seams(obj, edges)
        return seams, self._prints_of(maps, [atlas.fingerprint() for atlas in written])

    def _write_cut(self, objs, maps, result, uvs, _on_failure):
        """What can fail is done for every object before the first is changed: divided faces are not put together again."""
        rehearsed, seams = [], []
        for k, (obj, uv_map) in enumerate(zip(objs, maps, strict=True)):
            cuts.check_divisible(obj)  # again: its mode may be another by now
            plan = plan_cut(self.parts[k].atlas, *self.request.joined.cut_of(k, result.cut, uvs))
            rehearsed.append(cuts.rehearse_cut(obj, uv_map, plan, self.options.mark_seams))
            seams.append(plan.new_seams)
        for write in rehearsed:
            write()
        return seams, self._prints_of(maps, [_print(obj.name, uv_map) for obj, uv_map in zip(objs, maps, strict=True)])

    def _done(self, result, prints, seams=()):
        new_seams = tuple(zip((part.name for part in self.parts), seams, strict=False))
        return self._shown(prints, self.title, result=result, left=self._left(result), new_seams=new_seams)

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
        box = {name: self.request.arguments[name] for name in ("box_aspect", "in_texture")}
        for name, arrays in self.request.boxes():
            measures = engine.measure(*arrays, **box)
            yield self._shown(prints, ", ".join(filter(None, (self.title, name))), measures=measures)

    def _shown(self, prints, title, **found):
        request = self.request
        density = request.density(self.options, self.texture, self.metres, found.get("result"))
        is_free = not request.arguments["in_texture"]
        beyond = request.reaches_beyond and not is_free
        fixed = (title, request.face_count, is_free, beyond, self.options.max_distortion)
        return Done(*fixed, notes=tuple(self.notes), prints=prints, density=density, **found)


class Run:
    """All atlases of one call, one after the other; what comes of them is written at the end."""

    writes = True

    def __init__(self, context, options, keywords=None, beside_window=False):
        """`keywords`: the engine's, besides those of the options."""
        self.problems = []  # (object's name, why nothing was done with it)
        self.atlases = self._read(context, options)
        # One core is left to the window.
        automatic = max(1, (os.cpu_count() or 1) - 1) if beside_window else 0
        self._threads = options.threads or preferences.get().threads or automatic
        self.errors = []  # those of the engine and of writing, after finish()
        self.cancelled = False
        self.finishing = False
        self._at = 0
        self._keywords = keywords or {}
        if self.atlases:
            self.atlases[0].start(self._threads, self._keywords)

    def _read(self, context, options):
        return read_atlases(context, options, self.problems)

    @property
    def done(self):
        """Starts the next atlas where one has come to its end."""
        while self._at < len(self.atlases) and self.atlases[self._at].job.done:
            self._at = len(self.atlases) if self.cancelled or self.finishing else self._at + 1
            if self._at < len(self.atlases):
                self.atlases[self._at].start(self._threads, self._keywords)
        return self._at >= len(self.atlases)

    @property
    def begun(self):
        """All atlases, but for those that keep_best() came before."""
        return [atlas for atlas in self.atlases if atlas.job is not None]

    def wait(self, seconds):
        """True where all are done."""
        if self._at < len(self.atlases):
            self.atlases[self._at].job.wait(seconds)
        return self.done

    @property
    def progress(self):
        """(the engine's progress, fraction of the whole)."""
        at = min(self._at, len(self.atlases) - 1)
        progress = self.atlases[at].job.progress
        return progress, (at + progress.fraction) / len(self.atlases)

    def cancel(self):
        """Unless all are done."""
        if self._at < len(self.atlases):
            self.cancelled = True
            self.atlases[self._at].job.cancel()

    def keep_best(self):
        """Ends with the best valid atlas so far; those that were not begun stay as they are."""
        if self._at < len(self.atlases):
            self.finishing = True
            self.atlases[self._at].job.finish()

    def stop(self):
        """Cancels and waits for the engine's thread."""
        self.cancel()
        if self._at < len(self.atlases):
            self.atlases[self._at].job.wait()

    def finish(self):
        """Writes what came and returns it, a Done for each atlas; `problems` has the others."""
        out = []
        for atlas in self.begun:
            try:
                out.append(atlas.write(atlas.job.result()))
            except FAILURES as error:
                self.problems.append((atlas.title, str(error)))
                self.errors.append(error)
        if out:
            show(out)
        return out


def read_atlases(context, options, problems):
    """The atlases that the options ask for; what cannot be used goes to `problems`."""
    usable = []
    for obj in objects.objects_of(context):
        reason = objects.why_not(obj)
        if reason:
            problems.append((obj.name, reason))
        else:
            usable.append(obj)
    by_object = options.atlases == "OBJECT"
    out, idle = [], []
    for objs in ([obj] for obj in usable) if by_object else [usable] if usable else []:
        try:
            out.append(Atlas(context, objs, options))
        except NothingToDoError as error:
            idle.append((_title(objs), str(error)))
        except FAILURES as error:
            problems.append((_title(objs), str(error)))
    # Of several objects those without a selection are simply not meant.
    if not out and not problems:
        problems += idle
    return out


def measure_all(context, options, problems):
    """A Done for each atlas as it is."""
    out = []
    for atlas in read_atlases(context, replace(options, seams="NONE"), problems):  # it cuts nothing: what bars cuts is no matter
        try:
            out += atlas.measure()
        except FAILURES as error:
            problems.append((atlas.title, str(error)))
    if out:
        show(out)
    return out


def _title(objs):
    return objs[0].name if len(objs) == 1 else counted(len(objs), "object")


def _read(context, obj, options, material_numbers):
    try:
        return objects.read_part(context, obj, options, material_numbers)
    except bridge.MeshError as error:
        raise bridge.MeshError(f"{obj.name}: {error}") from error


def _require_names(parts, options):
    for option in ("keep_shape", "importance", "no_seam", "prefer_seam"):
        name = getattr(options, option)
        if name and all(getattr(part, option) is None for part in parts):
            what = "edge attribute" if option.endswith("seam") else "vertex group and no face attribute"
            raise bridge.MeshError(f'there is no {what} "{name}"')


def _notes(obj):
    users = objects.users_of(obj.data)
    if users > 1:
        yield f"{obj.name}: {users} objects share the mesh, and all of them change"
    if bridge.has_uneven_scale(obj):
        yield f"{obj.name}: the object's scale is uneven; the UVs follow the mesh without it"


def show(done):
    global last, _in_doubt
    last, _in_doubt = done, False


def last_if_true():
    """`last`, after a look at the meshes where something may have changed them."""
    global last, _in_doubt
    if last is not None and _in_doubt:
        _in_doubt = False
        if not all(is_true_of(done.prints) for done in last):
            last = None
    return last


def last_to_draw():
    """`last`; where something may have changed the meshes they are looked at once it is drawn."""
    if last is not None and _in_doubt:
        once_drawn(_look_again)
    return last


def _look_again():
    if last is not None and last_if_true() is None:
        drawing.redraw_panels(bpy.context)


def is_true_of(prints):
    """Whether the meshes are as they were."""
    return all(_print(name, uv_map) == known for name, uv_map, known in prints)


def new_seams(object_name):
    """(S, 2) vertices of the object's edges that the run whose result is shown has cut."""
    found = [edges for done in last_if_true() or () for name, edges in done.new_seams if name == object_name]
    return np.concatenate(found) if found else np.zeros((0, 2), dtype=np.int64)


def faces_left(object_name):
    """The object's faces that the run whose result is shown left as they are."""
    left = [faces for done in last_if_true() or () for name, faces in done.left if name == object_name]
    return np.concatenate(left) if left else np.zeros(0, dtype=np.int64)


def _print(object_name, uv_map):
    """Of all that a result is true of; None where it is gone."""
    obj = bpy.data.objects.get(object_name)
    if obj is None or obj.type != "MESH" or uv_map not in obj.data.uv_layers:
        return None
    return bridge.read_atlas(obj, uv_map).fingerprint()


def stop_running():
    """Ends the run, if there is one, and waits for its thread: before a file is loaded and on unregister."""
    global running
    if running is not None:
        running.stop()
        running = None


def _doubt():
    global _in_doubt
    _in_doubt = True


def _forget():
    global last
    stop_running()
    last = None


_watch = Watch(_forget, _doubt, is_needed=lambda: last is not None)


def register():
    _watch.register()


def unregister():
    no_longer(_look_again)
    _forget()
    _watch.unregister()
