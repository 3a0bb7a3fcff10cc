# SPDX-License-Identifier: GPL-3.0-or-later
"""The panel's options, kept in the scene."""

import bpy
from bpy.props import PointerProperty

from . import preferences
from .properties import PREFERRED, SEAMS, other_properties


def _seams_number(identifier):
    """An enum's getter gives its number."""
    return next(number for name, _, _, number in SEAMS if name == identifier)


def _follow_preference(name):
    """A scene's value is the preference's until somebody sets it there: preferences are the defaults of new scenes."""
    key = f"own_{name}"

    def get(scene_settings):
        value = scene_settings.get(key)
        if value is not None:
            return value
        value = getattr(preferences.get(), name)
        return _seams_number(value) if name == "seams" else value

    return {"get": get, "set": lambda scene_settings, value: scene_settings.__setitem__(key, value)}


class AtlasRefineSettings(bpy.types.PropertyGroup):
    """The panel's options, kept in the scene."""

    __annotations__ = {
        **{name: make(**_follow_preference(name)) for name, make in PREFERRED.items()},
        **other_properties(),
    }


def register():
    bpy.utils.register_class(AtlasRefineSettings)
    bpy.types.Scene.atlas_refine = PointerProperty(type=AtlasRefineSettings)


def unregister():
    del bpy.types.Scene.atlas_refine
    bpy.utils.unregister_class(AtlasRefineSettings)
