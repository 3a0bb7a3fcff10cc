# SPDX-License-Identifier: GPL-3.0-or-later
"""The panel's options, kept in the scene."""

import bpy
from bpy.props import PointerProperty

from . import preferences
from .properties import SEAMS, other_properties, pe_bound_property, seams_property, sigma_property


def _seams_number(identifier):
    """An enum's getter gives its number."""
    return next(number for name, _, _, number in SEAMS if name == identifier)


def _follow_preference(name, stored=lambda value: value):
    """A scene's value is the preference's until somebody sets it there: preferences are the defaults of new scenes."""
    key = f"own_{name}"
    return {
        "get": lambda scene_settings: scene_settings.get(key, stored(getattr(preferences.get(), name))),
        "set": lambda scene_settings, value: scene_settings.__setitem__(key, value),
    }


class AtlasRefineSettings(bpy.types.PropertyGroup):
    """The panel's options, kept in the scene."""

    __annotations__ = {
        "pe_bound": pe_bound_property(**_follow_preference("pe_bound")),
        "seams": seams_property(**_follow_preference("seams", _seams_number)),
        "sigma": sigma_property(**_follow_preference("sigma")),
        **other_properties(),
    }


def register():
    bpy.utils.register_class(AtlasRefineSettings)
    bpy.types.Scene.atlas_refine = PointerProperty(type=AtlasRefineSettings)


def unregister():
    del bpy.types.Scene.atlas_refine
    bpy.utils.unregister_class(AtlasRefineSettings)
