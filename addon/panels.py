# SPDX-License-Identifier: GPL-3.0-or-later
"""The tab "Atlas Refine" in the sidebars of UV editor and 3D view, and entries in the UV menus."""

import bpy

from . import drawing, operators, overlay_settings, presets, tasks, trade_off
from .bridge import versions
from .core.density import density_lines
from .core.summary import (
    change_of_use,
    distortion,
    faces_after,
    figures,
    in_parts,
    measures_held,
    missed,
    new_seams,
    uses_of_groups,
    what_was_done,
)
from .core.words import ICON_PX, counted, lines_of, phase
from .properties import copy_options, to_options

MOST_NOTES = 6


def _column(layout):
    column = layout.column()
    column.use_property_split = True
    column.use_property_decorate = False
    return column


def _tell(layout, context, text, icon="NONE"):
    """In as many lines as the sidebar's width asks for."""
    width = context.region.width / context.preferences.system.ui_scale
    for line in lines_of(text, width - (ICON_PX if icon != "NONE" else 0)):
        layout.label(text=line, icon=icon)
        icon = icon if icon == "NONE" else "BLANK1"


def _refine_button(layout, settings, **more):
    layout.operator_context = "INVOKE_DEFAULT"
    copy_options(settings, layout.operator(operators.UV_OT_atlas_refine.bl_idname, **more))


class _Main:
    bl_label = "Atlas Refine"

    def draw_header_preset(self, _context):
        presets.ATLAS_REFINE_PT_presets.draw_panel_header(self.layout)

    def draw(self, context):
        settings = context.scene.atlas_refine
        drawing.draw_use(_column(self.layout), settings)
        if tasks.running is not None:
            stage, fraction = tasks.running.progress
            versions.progress_bar(self.layout, fraction, phase(stage).capitalize())
            if tasks.running.writes:
                self.layout.operator(operators.UV_OT_atlas_refine_keep_best.bl_idname, icon="CHECKMARK")
            self.layout.label(text="Enter does so too, Esc cancels" if tasks.running.writes else "Esc cancels")
        else:
            row = self.layout.row()
            row.scale_y = 1.4
            _refine_button(row, settings, icon="UV")
        drawing.draw_main(_column(self.layout), settings, context)
        column = self.layout.column(align=True)
        column.operator_context = "INVOKE_DEFAULT"
        column.operator(operators.UV_OT_atlas_refine_measure.bl_idname, text="Measure")
        column.operator(operators.UV_OT_atlas_refine_select_problems.bl_idname, text="Select Problems")


class _TradeOff:
    bl_label = "Trade-off"

    @classmethod
    def poll(cls, context):
        return super().poll(context) and context.scene.atlas_refine.seams == "NEEDED"

    def draw(self, context):
        self.layout.operator_context = "INVOKE_DEFAULT"
        self.layout.operator(operators.UV_OT_atlas_refine_trade_off.bl_idname)
        if trade_off.shown is None:
            return
        reason = trade_off.why_not(to_options(context.scene.atlas_refine))
        if reason:
            self.layout.label(text=reason, icon="INFO")
            return
        grid = self.layout.grid_flow(row_major=True, columns=3, even_columns=True, align=True)
        for text in ("Seams", "Distortion", ""):
            grid.label(text=text)
        for point, (seams, distortion_of_it, _) in enumerate(trade_off.shown.lines):
            grid.label(text=seams)
            grid.label(text=distortion_of_it)
            button = grid.operator(operators.UV_OT_atlas_refine.bl_idname, text="Use")
            copy_options(trade_off.shown.options, button)
            button.point = point


class _Protected:
    bl_label = "Keep and Protect"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        drawing.draw_protected(_column(self.layout), context.scene.atlas_refine)


class _Advanced:
    bl_label = "Advanced"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        drawing.draw_advanced(_column(self.layout), context.scene.atlas_refine)


class _Overlay:
    bl_label = "Overlay"

    def draw(self, context):
        overlay_settings.draw(self.layout, context)


def _draw_density(layout, context, densities):
    for name, density in densities:
        for line in density_lines(density, name if len(densities) > 1 else ""):
            _tell(layout, context, line)
    by_size = [density for _, density in densities if not density.of_image]  # an image's size is its own
    if not by_size:
        return
    density = max(by_size, key=lambda one: one.needed_px)
    if density.size_to_take:
        button = layout.operator("wm.context_set_int", text=f"Set Texture Size to {density.size_to_take}")
        button.data_path, button.value = "scene.atlas_refine.texture_size", density.size_to_take


class _Result:
    bl_label = "Last Result"

    @classmethod
    def poll(cls, context):
        return super().poll(context) and tasks.last_to_draw() is not None

    def draw(self, context):
        for done in tasks.last or ():
            box = self.layout.box().column(align=True)
            if done.result is None:
                _tell(box, context, f"{done.title}: measured", icon="INFO")
                _tell(box, context, done.headline)
                _draw_density(box, context, done.densities)
            else:
                self._draw_result(box, context, done)

    def _draw_result(self, layout, context, done):
        before, after = done.result.before, done.result.after
        icon = "CHECKMARK" if done.result.bound_met else "ERROR"
        _tell(layout, context, f"{done.title}: {what_was_done(done.result, done.asked)}", icon)
        lines = [] if done.result.groups else [change_of_use(done.result, done.is_free, done.reached_beyond, done.asked)]
        lines += [f"{name or done.title}: {share}" for name, share in uses_of_groups(done.result, done.asked)]
        lines += [f"Missed: {text}" for text in missed(done.result, done.asked)]
        lines += [line.capitalize() for line in (*in_parts(distortion(measures_held(done.result))), *new_seams(done.result))]
        for line in lines:
            _tell(layout, context, line)
        _draw_density(layout, context, done.densities)
        if done.result.cut is not None:
            faces = faces_after(done.result, done.face_count)
            _tell(layout, context, f"Faces {done.face_count} -> {faces}, charts {before.chart_count} -> {after.chart_count}")
        told = [*done.notes, *done.mended]
        for note in told[:MOST_NOTES]:
            _tell(layout, context, note, icon="DOT")
        if len(told) > MOST_NOTES:
            _tell(layout, context, f"{counted(len(told) - MOST_NOTES, 'more note')} in the Info editor", icon="DOT")


class _Details:
    bl_label = "Details"
    bl_options = {"DEFAULT_CLOSED"}

    @classmethod
    def poll(cls, context):
        return super().poll(context) and any(done.result for done in tasks.last or ())

    def draw(self, _context):
        for done in tasks.last or ():
            if done.result is None:
                continue
            self.layout.label(text=done.title)
            grid = self.layout.grid_flow(row_major=True, columns=3, even_columns=True, align=True)
            for text in ("", "Before", "After"):
                grid.label(text=text)
            for row in figures(done.result, done.face_count):
                for text in row:
                    grid.label(text=text)
            self.layout.label(text=f"{sum(done.result.timings.values()):.1f} s")


class _InUvEditor:
    bl_space_type = "IMAGE_EDITOR"
    bl_region_type = "UI"
    bl_category = "Atlas Refine"

    @classmethod
    def poll(cls, context):
        return context.space_data.mode == "UV"


class _In3dView:
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Atlas Refine"

    @classmethod
    def poll(cls, context):
        return context.mode in {"OBJECT", "EDIT_MESH"}


def _panels():
    """One class for each panel and editor."""
    for prefix, editor in (("IMAGE", _InUvEditor), ("VIEW3D", _In3dView)):
        main = f"{prefix}_PT_atlas_refine"
        result = f"{main}_result"
        for name, panel, parent in (
            (main, _Main, None),
            (f"{main}_trade_off", _TradeOff, main),
            (f"{main}_protected", _Protected, main),
            (f"{main}_advanced", _Advanced, main),
            (f"{main}_overlay", _Overlay, main),
            (result, _Result, main),
            (f"{main}_details", _Details, result),
        ):
            attributes = {"bl_idname": name, **({"bl_parent_id": parent} if parent else {})}
            yield type(name, (panel, editor, bpy.types.Panel), attributes)


CLASSES = tuple(_panels())


def _draw_menu(self, context):
    self.layout.separator()
    _refine_button(self.layout, context.scene.atlas_refine, text="Refine Atlas", icon="UV")
    for operator in (operators.UV_OT_atlas_refine_measure, operators.UV_OT_atlas_refine_select_problems):
        self.layout.operator(operator.bl_idname)


#: The last one so that F3 finds the operators in the 3D view's object mode, which has no UV menu.
MENUS = ("IMAGE_MT_uvs", "VIEW3D_MT_uv_map", "VIEW3D_MT_object")


def register():
    for cls in CLASSES:
        bpy.utils.register_class(cls)
    for menu in MENUS:
        getattr(bpy.types, menu).append(_draw_menu)


def unregister():
    for menu in reversed(MENUS):
        getattr(bpy.types, menu).remove(_draw_menu)
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
