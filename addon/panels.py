# SPDX-License-Identifier: GPL-3.0-or-later
"""The tab "Atlas Refine" in the UV editor's sidebar."""

import bpy

from . import tasks
from .bridge import versions
from .core.summary import figures
from .operators import UV_OT_atlas_refine, draw_options
from .properties import OPTION_NAMES


class _AtlasRefinePanel:
    bl_space_type = "IMAGE_EDITOR"
    bl_region_type = "UI"
    bl_category = "Atlas Refine"

    @classmethod
    def poll(cls, context):
        return context.space_data.mode == "UV"


class IMAGE_PT_atlas_refine(_AtlasRefinePanel, bpy.types.Panel):
    bl_label = "Atlas Refine"

    def draw(self, context):
        settings = context.scene.atlas_refine
        column = self.layout.column()
        column.use_property_split = True
        column.use_property_decorate = False
        draw_options(column, settings)
        if tasks.running is not None:
            progress = tasks.running.job.progress
            versions.progress_bar(self.layout, progress.fraction, progress.stage.capitalize())
            self.layout.label(text="Esc stops")
            return
        row = self.layout.row()
        row.scale_y = 1.4
        row.operator_context = "INVOKE_DEFAULT"
        button = row.operator(UV_OT_atlas_refine.bl_idname, icon="UV")
        for name in OPTION_NAMES:
            setattr(button, name, getattr(settings, name))


class IMAGE_PT_atlas_refine_result(_AtlasRefinePanel, bpy.types.Panel):
    bl_label = "Last Result"
    bl_parent_id = "IMAGE_PT_atlas_refine"

    @classmethod
    def poll(cls, context):
        return super().poll(context) and tasks.last is not None

    def draw(self, _context):
        object_name, face_count, result = tasks.last
        self.layout.label(text=f"{object_name}: {result.intervention}", icon="CHECKMARK" if result.bound_met else "ERROR")
        grid = self.layout.grid_flow(row_major=True, columns=3, even_columns=True, align=True)
        for text in ("", "Before", "After"):
            grid.label(text=text)
        for row in figures(result, face_count):
            for text in row:
                grid.label(text=text)


CLASSES = (IMAGE_PT_atlas_refine, IMAGE_PT_atlas_refine_result)


def register():
    for cls in CLASSES:
        bpy.utils.register_class(cls)


def unregister():
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
