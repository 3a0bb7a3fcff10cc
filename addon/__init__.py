# SPDX-License-Identifier: GPL-3.0-or-later
"""The Blender add-on: brings a UV map to a packing efficiency bound.

operators.py and panels.py are thin; core/ knows no bpy; bridge/ holds every access to mesh data and every difference
between Blender versions; native/ (added by `./dev package`) is the Python package with the engine.
"""

import sys

# Installed anew, this module alone is loaded again: what an earlier version brought must not be found.
for _name in [name for name in sys.modules if name.startswith(f"{__name__}.")]:
    del sys.modules[_name]
    globals().pop(_name.removeprefix(f"{__name__}."), None)

from . import headless, operators, overlay_settings, panels, preferences, presets, reinstalled, settings

bl_info = {
    "name": "Atlas Refine",
    "author": "Atlas Refine contributors",
    "version": (0, 1, 0),
    "blender": (3, 4, 0),
    "location": "Sidebar of UV Editor and 3D View > Atlas Refine; UV menus",
    "description": "Bring a UV map to a packing efficiency bound",
    "category": "UV",
}

MODULES = (preferences, settings, operators, presets, overlay_settings, panels, headless, reinstalled)


def register():
    for module in MODULES:
        module.register()


def unregister():
    for module in reversed(MODULES):
        module.unregister()
