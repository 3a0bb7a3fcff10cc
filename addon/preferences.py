# SPDX-License-Identifier: GPL-3.0-or-later
"""The add-on's preferences: the values that new scenes start with, threads, and where the studio keeps its presets."""

import pathlib
from types import SimpleNamespace

import bpy
from bpy.props import IntProperty, StringProperty

from .properties import PREFERRED, overlay_properties


class AtlasRefinePreferences(bpy.types.AddonPreferences):
    bl_idname = __package__

    __annotations__ = {
        **{name: make() for name, make in PREFERRED.items()},
        "threads": IntProperty(
            name="Threads",
            description="Processor threads where the Threads of a refinement is 0. 0: all but one, which Blender's window keeps, in "
            "scripts all. The result is the same",
            default=0,
            min=0,
            max=1024,
        ),
        "studio_presets": StringProperty(
            name="Studio Presets",
            description="Folder of presets that everybody in the studio has. It is only read",
            subtype="DIR_PATH",
            default="",
        ),
        **overlay_properties(),
    }

    def draw(self, _context):
        column = self.layout.column()
        column.use_property_split = True
        column.label(text="Defaults for new scenes")
        for name in PREFERRED:
            column.prop(self, name)
        column.separator()
        column.prop(self, "threads")
        column.prop(self, "studio_presets")
        if self.studio_presets and not pathlib.Path(bpy.path.abspath(self.studio_presets)).is_dir():
            column.label(text="There is no such folder", icon="ERROR")
        column.separator()
        column.label(text="Overlay")
        for name in overlay_properties():
            column.prop(self, name)


_DEFAULTS = SimpleNamespace(**{name: made.keywords["default"] for name, made in AtlasRefinePreferences.__annotations__.items()})


def get():
    """The preferences, or their defaults where the add-on runs without having been ticked (Blender's --addons)."""
    addon = bpy.context.preferences.addons.get(__package__)
    return _DEFAULTS if addon is None else addon.preferences


def register():
    bpy.utils.register_class(AtlasRefinePreferences)


def unregister():
    bpy.utils.unregister_class(AtlasRefinePreferences)
