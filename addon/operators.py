# SPDX-License-Identifier: GPL-3.0-or-later
"""uv.atlas_refine: at once in scripts, beside Blender with progress and Esc from a button."""

import bpy
from bpy.props import StringProperty

from . import tasks
from .core.summary import headline
from .properties import other_properties, pe_bound_property, seams_property, sigma_property, to_options

POLL_SECONDS = 0.1


class UV_OT_atlas_refine(bpy.types.Operator):
    """Bend, place and, where Seams allows it, cut the charts of the active object's UV map until it holds the packing efficiency bound"""

    bl_idname = "uv.atlas_refine"
    bl_label = "Refine Atlas"
    bl_options = {"REGISTER", "UNDO"}

    __annotations__ = {
        "pe_bound": pe_bound_property(),
        "seams": seams_property(),
        "sigma": sigma_property(),
        **other_properties(),
        "uv_map": StringProperty(name="UV Map", description="Name or index of the UV map; empty: the active one"),
    }

    @classmethod
    def poll(cls, context):
        obj = context.active_object
        if obj is None or obj.type != "MESH":
            cls.poll_message_set("Needs an active mesh object")
            return False
        if tasks.running is not None:
            cls.poll_message_set("A refinement is running; Esc stops it")
            return False
        return True

    def draw(self, _context):
        layout = self.layout
        layout.use_property_split = True
        layout.prop(self, "uv_map")
        draw_options(layout, self)

    def execute(self, context):
        task = self._start(context)
        if task is None:
            return {"CANCELLED"}
        while not task.job.wait(POLL_SECONDS):  # in steps, so that Ctrl-C is heard
            pass
        return self._finish(task)

    def invoke(self, context, _event):
        if bpy.app.background:
            return self.execute(context)
        self._task = self._start(context, beside_window=True)
        if self._task is None:
            return {"CANCELLED"}
        tasks.running = self._task
        self._shown = ""
        self._timer = context.window_manager.event_timer_add(POLL_SECONDS, window=context.window)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        job = self._task.job
        if event.type == "ESC" and event.value == "PRESS":
            job.cancel()
            return {"RUNNING_MODAL"}
        if event.type != "TIMER":
            return {"PASS_THROUGH"}
        if not job.done:
            self._show_progress(context, job.progress)
            return {"PASS_THROUGH"}
        self._leave(context)
        return self._finish(self._task)

    def cancel(self, context):
        """Blender ends the operator: another file, a closed window."""
        self._leave(context)

    def _start(self, context, beside_window=False):
        obj = context.active_object
        try:
            return tasks.Task(obj, self.uv_map, to_options(self), beside_window)
        except tasks.FAILURES as error:
            self._report_failure(obj.name, error)
            return None

    def _finish(self, task):
        try:
            result = task.finish()
        except tasks.FAILURES as error:
            self._report_failure(task.object_name, error)
            return {"CANCELLED"}
        for warning in task.warnings(result):
            self.report({"WARNING"}, f"{task.object_name}: {warning}")
        self.report({"INFO"}, f"{task.object_name}: {headline(result)}")
        return {"FINISHED"}

    def _report_failure(self, object_name, error):
        text = str(error)
        cancelled = getattr(error, "code", "") == "cancelled"
        self.report({"INFO" if cancelled else "ERROR"}, text if object_name in text else f"{object_name}: {text}")

    def _show_progress(self, context, progress):
        efficiency = f", PE {progress.pe:.2f}" if progress.pe else ""
        text = f"Refining: {progress.stage} {100 * progress.fraction:.0f} %{efficiency} (Esc stops)"
        if text != self._shown:  # each redraw costs the window time
            self._shown = text
            context.workspace.status_text_set(text)
            redraw_panels(context)

    def _leave(self, context):
        tasks.stop_running()
        context.window_manager.event_timer_remove(self._timer)
        if context.workspace is not None:
            context.workspace.status_text_set(None)
        redraw_panels(context)


def draw_options(layout, holder):
    """The options, in the panel and in the redo panel alike."""
    layout.prop(holder, "pe_bound")
    layout.prop(holder, "seams")
    if holder.seams == "RECTANGLES":
        layout.prop(holder, "cut")
        layout.prop(holder, "sigma")
    layout.prop(holder, "open_closed")
    layout.prop(holder, "stacks")
    layout.prop(holder, "density")
    layout.prop(holder, "aspect")
    layout.prop(holder, "gap")
    if holder.gap == "PIXELS":
        layout.prop(holder, "gap_px", text="Pixels")
        layout.prop(holder, "texture_size")
    layout.prop(holder, "seed")
    layout.prop(holder, "best_effort")


def redraw_panels(context):
    for window in context.window_manager.windows:
        for area in window.screen.areas:
            if area.type == "IMAGE_EDITOR":
                for region in area.regions:
                    if region.type == "UI":
                        region.tag_redraw()


@bpy.app.handlers.persistent
def _before_load(*_):
    tasks.stop_running()


def register():
    bpy.utils.register_class(UV_OT_atlas_refine)
    bpy.app.handlers.load_pre.append(_before_load)


def unregister():
    tasks.stop_running()
    bpy.app.handlers.load_pre.remove(_before_load)
    bpy.utils.unregister_class(UV_OT_atlas_refine)
