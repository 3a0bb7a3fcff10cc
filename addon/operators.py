# SPDX-License-Identifier: GPL-3.0-or-later
"""uv.atlas_refine: at once in scripts, beside Blender with progress and Esc from a button. And its two helpers, which measure and
select."""

import bpy
from bpy.props import EnumProperty

from . import drawing, engine, presets, tasks
from .bridge import parts as objects
from .bridge import problems, selection
from .bridge.mesh import MeshError, find_uv_map
from .core.presets import PresetError
from .core.summary import headline, measured, notes
from .core.words import counted, phase, plain
from .properties import all_properties, to_options

POLL_SECONDS = 0.1


def poll_objects(cls, context):
    """Whether there is something to work on; the message says why not."""
    found = objects.objects_of(context)
    if not found:
        cls.poll_message_set("Select a mesh object")
        return False
    reasons = [(obj.name, objects.why_not(obj)) for obj in found]
    if all(reason for _, reason in reasons):
        cls.poll_message_set(f"{reasons[0][0]}: {reasons[0][1]}")
        return False
    if tasks.running is not None:
        cls.poll_message_set("A refinement is running; Esc cancels it")
        return False
    return True


def report_problem(operator, name, text):
    text = plain(text)
    operator.report({"ERROR"}, text if text.startswith(name) else f"{name}: {text}")


class UV_OT_atlas_refine(bpy.types.Operator):
    """Move, bend and, where Seams allows it, cut the UV charts of the selected objects until they cover the wanted part of the texture"""

    bl_idname = "uv.atlas_refine"
    bl_label = "Refine Atlas"
    bl_options = {"REGISTER", "UNDO", "PRESET"}

    __annotations__ = {**all_properties(), "preset": presets.preset_property()}

    @classmethod
    def poll(cls, context):
        return poll_objects(cls, context)

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        drawing.draw_use(layout, self)
        drawing.draw_main(layout, self, context)
        drawing.draw_protected(layout, self, context)
        drawing.draw_advanced(layout, self)

    def execute(self, context):
        run = self._start(context)
        if run is None:
            return {"CANCELLED"}
        while not run.wait(POLL_SECONDS):  # in steps, so that Ctrl-C is heard
            pass
        return self._finish(run)

    def invoke(self, context, _event):
        if bpy.app.background:
            return self.execute(context)
        self._run = self._start(context, beside_window=True)
        if self._run is None:
            return {"CANCELLED"}
        tasks.running = self._run
        self._shown = ""
        self._timer = context.window_manager.event_timer_add(POLL_SECONDS, window=context.window)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        if event.type == "ESC" and event.value == "PRESS":
            self._run.cancel()
            return {"RUNNING_MODAL"}
        if event.type in {"RET", "NUMPAD_ENTER"} and event.value == "PRESS" and drawing.is_over_uv_or_3d_view(context, event):
            self._run.keep_best()
            return {"RUNNING_MODAL"}
        if event.type != "TIMER":
            return {"PASS_THROUGH"}
        if not self._run.done:
            self._show_progress(context)
            return {"PASS_THROUGH"}
        self._leave(context)
        return self._finish(self._run)

    def cancel(self, context):
        """Blender ends the operator: another file, a closed window."""
        self._leave(context)

    def _start(self, context, beside_window=False):
        try:
            presets.apply_to(self)
        except PresetError as error:
            self.report({"ERROR"}, str(error))
            return None
        run = tasks.Run(context, to_options(self), beside_window)
        if run.atlases:
            return run
        for name, text in run.problems or [("Atlas Refine", "there is nothing to refine")]:
            report_problem(self, name, text)
        return None

    def _finish(self, run):
        if run.cancelled:
            self.report({"INFO"}, "Stopped; nothing was changed")
            return {"CANCELLED"}
        all_done = run.finish()
        for done in all_done:
            for note in (*done.notes, *notes(done.result)):
                self.report({"WARNING"}, note if note.startswith(done.title) else f"{done.title}: {note}")
        if waiting := len(run.atlases) - len(run.begun):
            self.report({"WARNING"}, f"Stopped before the turn of {counted(waiting, 'more object')}, left as before")
        for name, text in run.problems:
            report_problem(self, name, text)
        for done in all_done:
            self.report({"INFO"}, f"{done.title}: {headline(done.result, done.is_free, done.reached_beyond)}")
        return {"FINISHED"} if all_done else {"CANCELLED"}

    def _show_progress(self, context):
        progress, fraction = self._run.progress
        keys = "stopping" if self._run.finishing else "Enter: stop and keep the best, Esc: cancel"
        text = f"Refining: {phase(progress.stage)} {100 * fraction:.0f} % ({keys})"
        if text != self._shown:  # each redraw costs the window time
            self._shown = text
            context.workspace.status_text_set(text)
            drawing.redraw_panels(context)

    def _leave(self, context):
        tasks.stop_running()
        context.window_manager.event_timer_remove(self._timer)
        if context.workspace is not None:
            context.workspace.status_text_set(None)
        drawing.redraw_panels(context)


class UV_OT_atlas_refine_keep_best(bpy.types.Operator):
    """End the refinement now with the best valid UV map that it has found; where none is better than before, nothing is changed"""

    bl_idname = "uv.atlas_refine_keep_best"
    bl_label = "Stop and Keep Best"
    bl_options = {"INTERNAL"}

    @classmethod
    def poll(cls, _context):
        return tasks.running is not None and not tasks.running.finishing

    def execute(self, _context):
        tasks.running.keep_best()
        return {"FINISHED"}


class UV_OT_atlas_refine_measure(bpy.types.Operator):
    """Show how much of the texture the UV charts cover, and how distorted they are; nothing is changed"""

    bl_idname = "uv.atlas_refine_measure"
    bl_label = "Measure Atlas"
    bl_options = {"REGISTER"}

    @classmethod
    def poll(cls, context):
        return poll_objects(cls, context)

    def execute(self, context):
        trouble = []
        found = tasks.measure_all(context, to_options(context.scene.atlas_refine), trouble)
        for name, text in trouble:
            report_problem(self, name, text)
        for done in found:
            self.report({"INFO"}, f"{done.title}: {measured(done.measures, done.is_free, done.reached_beyond)}")
        drawing.redraw_panels(context)
        return {"FINISHED"} if found else {"CANCELLED"}


class UV_OT_atlas_refine_select_problems(bpy.types.Operator):
    """Select the faces that a refinement has to mend or to leave as they are"""

    bl_idname = "uv.atlas_refine_select_problems"
    bl_label = "Select UV Problems"
    bl_options = {"REGISTER", "UNDO"}

    __annotations__ = {
        "kinds": EnumProperty(
            name="Problems",
            description="What is selected",
            options={"ENUM_FLAG"},
            items=[(name.upper(), kind.label, kind.description) for name, kind in problems.KINDS.items()],
            default={name.upper() for name in problems.KINDS if name != "mirrored"},
        )
    }

    @classmethod
    def poll(cls, context):
        return poll_objects(cls, context)

    def execute(self, context):
        wanted = [kind for kind in problems.KINDS if kind.upper() in self.kinds]
        uv_map = context.scene.atlas_refine.uv_map
        found = [(obj, find_uv_map(obj.data, uv_map)) for obj in objects.objects_of(context) if self._is_usable(obj, uv_map)]
        if not found:
            return {"CANCELLED"}
        if context.mode != "EDIT_MESH":
            for obj, _ in found:
                obj.select_set(True)
            context.view_layer.objects.active = found[0][0]
            bpy.ops.object.mode_set(mode="EDIT")
        bpy.ops.mesh.select_mode(type="FACE")
        for obj, name in found:
            self._select(obj, name, wanted)
        return {"FINISHED"}

    def _is_usable(self, obj, uv_map):
        reason = objects.why_not(obj)
        if not reason:
            try:
                find_uv_map(obj.data, uv_map)
            except MeshError as error:
                reason = str(error)
        if reason:
            report_problem(self, obj.name, reason)
        return not reason

    def _select(self, obj, uv_map, wanted):
        faces = problems.find(engine.module, obj, uv_map, tasks.faces_left(obj.name))
        chosen = sorted({int(face) for kind in wanted for face in faces[kind]})
        selection.select_faces(obj, uv_map, chosen)
        words = [counted(len(faces[kind]), f"{problems.KINDS[kind].word} face") for kind in wanted if len(faces[kind])]
        self.report({"INFO"}, f"{obj.name}: {', '.join(words) or 'no problems'}")


CLASSES = (UV_OT_atlas_refine, UV_OT_atlas_refine_keep_best, UV_OT_atlas_refine_measure, UV_OT_atlas_refine_select_problems)


def register():
    for cls in CLASSES:
        bpy.utils.register_class(cls)
    tasks.register()


def unregister():
    tasks.unregister()
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
