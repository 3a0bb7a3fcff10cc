# SPDX-License-Identifier: GPL-3.0-or-later
"""Measure and Select Problems: runs without the engine's job, so that the window does not wait for them either."""

from dataclasses import replace

import bpy

from . import engine, tasks
from .bridge import mesh as bridge
from .bridge import problems, selection
from .core.words import counted


class _Look(tasks.Run):
    """Reads, looks beside the window, and has nothing to solve."""

    writes = False

    @property
    def progress(self):
        return ("certify", 0.5) if self._reading.done else ("input", 0.0)


class Measuring(_Look):
    doing = "Measuring"

    def _begin(self, context, options):
        options = replace(options, seams="NONE")  # it cuts nothing: what bars cuts is no matter
        self.atlases = yield from tasks.read_atlases(context, options, self.problems, moves=False)
        self._at = len(self.atlases)

    def _write(self):
        """A Done for each texture or tile as it is."""
        out = []
        for atlas in self.atlases:
            try:
                out += yield lambda atlas=atlas: list(atlas.measure())
            except tasks.FAILURES as error:
                self.problems.append((atlas.title, tasks.why(error)))
        if out:
            tasks.show(out)
        self._written = out


class Selecting(_Look):
    """Selects the faces that are at fault; what it returns tells how many, object by object. Hidden ones cannot be selected: they are
    told as such."""

    doing = "Looking"

    def __init__(self, context, options, kinds, beside_window):
        self._kinds = kinds
        self._faces = []  # (object's name, UV map, {kind: faces}, hidden faces)
        super().__init__(context, options, None, beside_window)

    def _begin(self, context, options):
        usable, without_map = tasks.usable_objects(context, options, self.problems)
        self.problems += without_map
        for obj in usable:
            uv_map = bridge.find_uv_map(obj.data, options.uv_map)
            name, left = obj.name, tasks.faces_left(obj.name)
            with bridge.mesh_to_read(obj) as mesh:
                yield
                atlas = bridge.atlas_of(mesh, uv_map)
                triangles = bridge.triangles_of(mesh, atlas)
                hidden = selection.hidden_faces(mesh)
            looked_at = atlas, triangles, name, left
            found = yield lambda looked_at=looked_at: problems.find(engine.module, *looked_at)
            self._faces.append((name, uv_map, {kind: found[kind] for kind in self._kinds}, hidden))
        self.atlases = self._faces
        self._at = len(self.atlases)

    def _write(self):
        objs = [bpy.data.objects[name] for name, *_ in self._faces]
        if bpy.context.mode != "EDIT_MESH":
            for obj in objs:
                obj.select_set(True)
            bpy.context.view_layer.objects.active = objs[0]
            bpy.ops.object.mode_set(mode="EDIT")
        bpy.ops.mesh.select_mode(type="FACE")
        told = []
        for obj, (name, uv_map, faces, hidden) in zip(objs, self._faces, strict=True):
            yield
            shown = {kind: found[~hidden[found]] for kind, found in faces.items()}
            yield from selection.select_in_steps(obj, uv_map, {int(face) for found in shown.values() for face in found})
            words = []
            for kind, found in faces.items():
                for count, noun in ((len(shown[kind]), "face"), (len(found) - len(shown[kind]), "hidden face")):
                    if count:
                        words.append(f"{counted(count, noun)} {problems.KINDS[kind].word}")
            told.append((name, ", ".join(words) or "no problems"))
        self._written = told
