# SPDX-License-Identifier: GPL-3.0-or-later
"""uv.atlas_refine, and its helpers, which measure, list the trade-off and select."""

import bpy
from bpy.props import EnumProperty, IntProperty

from . import again, drawing, looking, presets, tasks, trade_off
from .bridge import problems
from .core.notes import joined
from .core.presets import PresetError
from .core.words import counted
from .properties import all_properties, to_options
from .running import Runs


class _Refines(Runs):
    stopped = "Stopped; nothing was changed"

    def _finish(self, run):
        if run.cancelled:
            self.report({"INFO"}, self.stopped)
            return {"CANCELLED"}
        all_done = run.finish()
        for line in joined((done.title, note) for done in all_done for note in (*done.told, *done.mended)):
            self.report({"WARNING"}, line)
        if waiting := len(run.atlases) - len(run.begun):
            self.report({"WARNING"}, f"Stopped before the turn of {counted(waiting, 'more object')}, left as before")
        self.report_problems(run.problems)
        for done in all_done:
            self.report({"INFO"}, f"{done.title}: {done.headline}")
        return {"FINISHED"} if all_done else {"CANCELLED"}


class UV_OT_atlas_refine(_Refines, bpy.types.Operator):
    """Move, bend and, where Seams allows it, cut the UV charts of the selected objects until they cover the wanted part of the texture"""

    bl_idname = "uv.atlas_refine"
    bl_label = "Refine Atlas"
    bl_options = {"REGISTER", "UNDO", "PRESET"}

    replaces_again = True

    __annotations__ = {
        **all_properties(),
        "preset": presets.preset_property(),
        "point": IntProperty(
            name="Point",
            description="For Seams As Needed: which line of the trade-off the map becomes, from 0 on, whatever the limits; -1: what the "
            "limits ask for",
            default=-1,
            min=-1,
            options={"HIDDEN", "SKIP_SAVE"},
        ),
    }

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        drawing.draw_use(layout, self)
        drawing.draw_main(layout, self, context)
        drawing.draw_protected(layout, self)
        drawing.draw_advanced(layout, self)

    def execute(self, context):
        if not again.is_asked(context, self):
            return super().execute(context)
        options = self._options()
        if options is None:
            return {"CANCELLED"}
        tasks.stop_running()
        again.ask(context, options)
        return {"FINISHED"}  # its undo step is the result's once that is there

    def _start(self, context, beside_window=False):
        options = self._options()
        tasks.stop_running()
        return options and tasks.Run(context, *options, beside_window)

    def _options(self):
        """(options, keywords) of a run; None where the preset cannot be had."""
        try:
            presets.apply_to(self)
        except PresetError as error:
            self.report({"ERROR"}, str(error))
            return None
        return trade_off.picked(to_options(self), None if self.point < 0 else self.point)


class UV_OT_atlas_refine_again(_Refines, bpy.types.Operator):
    """Refine the atlas with the options that were adjusted"""

    bl_idname = "uv.atlas_refine_again"
    bl_label = UV_OT_atlas_refine.bl_label
    bl_options = {"INTERNAL", "UNDO_GROUPED"}
    bl_undo_group = UV_OT_atlas_refine.bl_label  # so that its undo step takes the place of that of execute() above

    stopped = "Stopped; the UV map is as it was before the refinement"

    def _start(self, context, beside_window=False):
        self._asked = again.take()
        return self._asked and tasks.Run(context, *self._asked.options, beside_window, is_again=True)

    def _finish(self, run):
        again.show_panel(self._asked)
        return super()._finish(run)


class UV_OT_atlas_refine_keep_best(bpy.types.Operator):
    """End the refinement now with the best valid UV map that it has found; where none is better than before, nothing is changed"""

    bl_idname = "uv.atlas_refine_keep_best"
    bl_label = "Stop and Keep Best"
    bl_options = {"INTERNAL"}

    @classmethod
    def poll(cls, _context):
        run = tasks.running
        return run is not None and run.writes and run.is_solving and not run.finishing

    def execute(self, _context):
        tasks.running.keep_best()
        return {"FINISHED"}


class UV_OT_atlas_refine_measure(Runs, bpy.types.Operator):
    """Show how much of the texture the UV charts cover, and how distorted they are; nothing is changed"""

    bl_idname = "uv.atlas_refine_measure"
    bl_label = "Measure Atlas"
    bl_options = {"REGISTER"}

    def _start(self, context, beside_window=False):
        return looking.Measuring(context, to_options(context.scene.atlas_refine), beside_window=beside_window)

    def _finish(self, run):
        if run.cancelled:
            return {"CANCELLED"}
        found = run.finish()
        self.report_problems(run.problems)
        for done in found:
            self.report({"INFO"}, f"{done.title}: {done.headline}")
        drawing.redraw_panels(bpy.context)
        return {"FINISHED"} if found else {"CANCELLED"}


class UV_OT_atlas_refine_trade_off(Runs, bpy.types.Operator):
    """List what can be had: new seams against distortion, each line to be picked. Nothing is changed; takes several refinements' time"""

    bl_idname = "uv.atlas_refine_trade_off"
    bl_label = "Show Trade-off"
    bl_options = {"REGISTER"}

    def _start(self, context, beside_window=False):
        options = to_options(context.scene.atlas_refine).for_trade_off()
        return trade_off.Search(context, options, beside_window)

    def _finish(self, run):
        if run.cancelled:
            self.report({"INFO"}, "Stopped; there is no trade-off to show")
            return {"CANCELLED"}
        found = run.finish()
        self.report_problems(run.problems)
        for note in run.told:
            self.report({"WARNING"}, f"{run.atlases[0].title}: {note}")
        for seams, distortion, cuts in found:
            self.report({"INFO"}, f"{run.atlases[0].title}: new seams {seams} ({cuts}), distortion {distortion}")
        drawing.redraw_panels(bpy.context)
        return {"FINISHED"} if found else {"CANCELLED"}


class UV_OT_atlas_refine_select_problems(Runs, bpy.types.Operator):
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

    def _start(self, context, beside_window=False):
        wanted = [kind for kind in problems.KINDS if kind.upper() in self.kinds]
        return looking.Selecting(context, to_options(context.scene.atlas_refine), wanted, beside_window)

    def _finish(self, run):
        if run.cancelled:
            return {"CANCELLED"}
        self.report_problems(run.problems)
        for name, text in run.finish():
            self.report({"INFO"}, f"{name}: {text}")
        return {"FINISHED"}


CLASSES = (
    UV_OT_atlas_refine,
    UV_OT_atlas_refine_again,
    UV_OT_atlas_refine_keep_best,
    UV_OT_atlas_refine_measure,
    UV_OT_atlas_refine_trade_off,
    UV_OT_atlas_refine_select_problems,
)


def register():
    for cls in CLASSES:
        bpy.utils.register_class(cls)
    tasks.register()
    trade_off.register()


def unregister():
    again.unregister()
    trade_off.unregister()
    tasks.unregister()
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
