# SPDX-License-Identifier: GPL-3.0-or-later
"""The add-on's preferences: the values that new scenes start with."""

import bpy

from .properties import overlay_properties, pe_bound_property, seams_property, sigma_property


def get():
    return bpy.context.preferences.addons[__package__].preferences


class AtlasRefinePreferences(bpy.types.AddonPreferences):
    bl_idname = __package__

    __annotations__ = {
        "pe_bound": pe_bound_property(),
        "seams": seams_property(),
        "sigma": sigma_property(),
        **overlay_properties(),
    }

    def draw(self, _context):
        column = self.layout.column()
        column.use_property_split = True
        column.label(text="Defaults for new scenes")
        column.prop(self, "pe_bound")
        column.prop(self, "seams")
        column.prop(self, "sigma")
        column.label(text="Overlay")
        for name in overlay_properties():
            column.prop(self, name)


def register():
    bpy.utils.register_class(AtlasRefinePreferences)


def unregister():
    bpy.utils.unregister_class(AtlasRefinePreferences)
