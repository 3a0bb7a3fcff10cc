# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender installs a zip over a legacy add-on that runs, and goes on with the old one: what was installed is loaded here."""

import pathlib

import addon_utils
import bpy

from . import tasks

PERIOD_SECONDS = 1.0
_INIT = pathlib.Path(__file__).with_name("__init__.py")
_loaded = None


def _stamp():
    """By which an installed version is told from another; None while there is none."""
    try:
        found = _INIT.stat()
    except OSError:
        return None
    return found.st_mtime_ns, found.st_size


def load_what_is_installed():
    """Seconds until the next look, None where another version is loaded now; a refinement is waited for."""
    found = _stamp()
    if found in (None, _loaded) or tasks.running is not None:
        return PERIOD_SECONDS
    addon_utils.disable(__package__)
    addon_utils.enable(__package__)
    return None


def register():
    global _loaded
    _loaded = _stamp()
    bpy.app.timers.register(load_what_is_installed, first_interval=PERIOD_SECONDS, persistent=True)


def unregister():
    if bpy.app.timers.is_registered(load_what_is_installed):
        bpy.app.timers.unregister(load_what_is_installed)
