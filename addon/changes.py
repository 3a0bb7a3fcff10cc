# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender's word that something changed, for those who keep what is true of a scene."""

import bpy


def once_drawn(function, seconds=0.0):
    """Calls it by and by: what makes data, as reading a mesh in edit mode does, must not run while something is drawn."""
    if not bpy.app.timers.is_registered(function):
        bpy.app.timers.register(function, first_interval=seconds)


def no_longer(function):
    if bpy.app.timers.is_registered(function):
        bpy.app.timers.unregister(function)


class Watch:
    """From register() on: before_load() before another file is opened, before_undo() before undo and redo, changed() after these, and
    after a mesh changed while is_needed() says so."""

    def __init__(self, before_load, changed, is_needed, before_undo=lambda: None):
        @bpy.app.handlers.persistent
        def on_load(*_):
            before_load()

        @bpy.app.handlers.persistent
        def on_undo_pre(*_):
            before_undo()

        @bpy.app.handlers.persistent
        def on_undo(*_):
            changed()

        @bpy.app.handlers.persistent
        def on_update(_scene, depsgraph):
            if is_needed() and any(update.is_updated_geometry for update in depsgraph.updates):
                changed()

        self._handlers = {
            "load_pre": on_load,
            "undo_pre": on_undo_pre,
            "redo_pre": on_undo_pre,
            "undo_post": on_undo,
            "redo_post": on_undo,
            "depsgraph_update_post": on_update,
        }

    def register(self):
        for name, function in self._handlers.items():
            getattr(bpy.app.handlers, name).append(function)

    def unregister(self):
        for name, function in self._handlers.items():
            getattr(bpy.app.handlers, name).remove(function)
