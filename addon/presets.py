# SPDX-License-Identifier: GPL-3.0-or-later
"""Presets in Blender: a button in the panel's header with those there are, and by name in scripts.

The user's own are files where Blender keeps presets of the operator, so that its redo panel has the same ones.
"""

import pathlib
from itertools import groupby

import bpy
from bl_operators.presets import AddPresetBase
from bl_ui.utils import PresetPanel
from bpy.props import StringProperty

from . import preferences
from .core.option_kinds import OptionKind
from .core.options import LEAST
from .core.presets import BUILT_IN, OWN, STUDIO, PresetError, find_presets, preset_named, preset_text, preset_values
from .properties import OPTION_NAMES

SUBFOLDER = "operator/uv.atlas_refine"  # where Blender keeps the presets of an operator
_TITLES = {OWN: "Your Own", STUDIO: "Studio", BUILT_IN: "Built-in"}


def option_kinds():
    """{option: OptionKind}, as Blender knows the operator's."""
    properties = bpy.ops.uv.atlas_refine.get_rna_type().properties
    return {name: _kind(properties[name]) for name in OPTION_NAMES}


def _kind(option):
    choices = tuple(item.identifier for item in option.enum_items) if option.type == "ENUM" else ()
    limits = {"low": option.hard_min, "high": option.hard_max} if option.type in {"INT", "FLOAT"} else {}
    if option.identifier in LEAST:
        limits["low"] = LEAST[option.identifier]
    return OptionKind(option.identifier, option.default, option.description, choices, **limits)


def all_presets():
    studio = preferences.get().studio_presets
    return find_presets(bpy.utils.preset_paths(SUBFOLDER), bpy.path.abspath(studio) if studio else "")


def values_of(name):
    """{option: value} of the preset of that name; PresetError where there is none, or it is broken."""
    return preset_values(preset_named(name, all_presets()), option_kinds())


def apply_to(operator):
    """Sets what the operator's preset says, but for what was given explicitly."""
    if not operator.preset:
        return
    for name, value in values_of(operator.preset).items():
        if not operator.properties.is_property_set(name):
            setattr(operator, name, value)


def preset_property():
    """Not saved: a run from a button never brings back the preset of an earlier one."""
    return StringProperty(
        name="Preset",
        description="Name of a preset, whose options hold unless they are given as well",
        default="",
        options={"HIDDEN", "SKIP_SAVE"},
    )


class UV_OT_atlas_refine_load_preset(bpy.types.Operator):
    """Set the options of Atlas Refine to those of the preset"""

    bl_idname = "uv.atlas_refine_load_preset"
    bl_label = "Load Atlas Refine Preset"
    bl_options = {"REGISTER", "UNDO", "INTERNAL"}

    __annotations__ = {"name": StringProperty(name="Name", description="Name of the preset")}

    def execute(self, context):
        try:
            values = values_of(self.name)
        except PresetError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        for name, value in values.items():
            setattr(context.scene.atlas_refine, name, value)
        return {"FINISHED"}


class UV_OT_atlas_refine_add_preset(AddPresetBase, bpy.types.Operator):
    """Keep the options of Atlas Refine as a preset, or remove one"""

    bl_idname = "uv.atlas_refine_add_preset"
    bl_label = "Add Atlas Refine Preset"
    preset_menu = "ATLAS_REFINE_PT_presets"
    preset_subdir = SUBFOLDER

    def add(self, context, filepath):
        """What AddPresetBase calls to write the file."""
        settings = context.scene.atlas_refine
        values = {name: getattr(settings, name) for name in OPTION_NAMES}
        pathlib.Path(filepath).write_text(preset_text(values), encoding="utf-8")


class ATLAS_REFINE_PT_presets(PresetPanel, bpy.types.Panel):
    bl_label = "Atlas Refine Presets"

    def draw(self, context):
        layout = self.layout
        layout.emboss = "PULLDOWN_MENU"
        layout.operator_context = "EXEC_DEFAULT"
        for source, presets in groupby(all_presets(), key=lambda preset: preset.source):
            column = layout.column(align=True)
            column.label(text=_TITLES[source])
            for preset in presets:
                row = column.row(align=True)
                row.operator(UV_OT_atlas_refine_load_preset.bl_idname, text=preset.name).name = preset.name
                if source == OWN:
                    remove = row.operator(UV_OT_atlas_refine_add_preset.bl_idname, text="", icon="REMOVE")
                    remove.name = preset.path.stem
                    remove.remove_name = True
        layout.separator()
        row = layout.row()
        field = row.row()
        field.emboss = "NORMAL"
        field.prop(context.window_manager, "preset_name", text="")
        row.operator(UV_OT_atlas_refine_add_preset.bl_idname, text="", icon="ADD").name = context.window_manager.preset_name


CLASSES = (UV_OT_atlas_refine_load_preset, UV_OT_atlas_refine_add_preset, ATLAS_REFINE_PT_presets)


def register():
    for cls in CLASSES:
        bpy.utils.register_class(cls)


def unregister():
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
