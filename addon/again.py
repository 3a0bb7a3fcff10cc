# SPDX-License-Identifier: GPL-3.0-or-later
"""Adjust Last Operation and Repeat Last, for which Blender calls execute() with its window waiting for the end. In a window they leave
the map as it was before the refinement, and what they ask for is begun right afterwards, with progress and Esc as from the button."""

from typing import NamedTuple

import bpy

from .changes import no_longer, once_drawn

#: A value that is being dragged comes many times.
PAUSE_SECONDS = 0.2


class Place(NamedTuple):
    """Of a call: addresses, as Blender's own objects may be gone by then."""

    window: int
    area: int


class Asked(NamedTuple):
    options: tuple  # of tasks.Run
    place: Place
    shows_panel: bool  # Blender's, in the corner of the area


_asked = None


def is_asked(context, operator):
    """Whether a window's execute() is called for what another call did before."""
    how = operator.options
    return context.window is not None and not bpy.app.background and (how.is_repeat or how.is_repeat_last)


def ask(context, options):
    global _asked
    regions = context.area.regions if context.area else ()
    shows_panel = any(region.type == "HUD" and region.width > 1 for region in regions)
    _asked = Asked(options, _place_of(context), shows_panel)
    no_longer(_begin)
    once_drawn(_begin, PAUSE_SECONDS)


def once_more(context, operator):
    """Begins an operator that changes nothing anew."""
    place, name = _place_of(context), type(operator).bl_idname.removeprefix("uv.")
    once_drawn(lambda: _invoke(place, getattr(bpy.ops.uv, name)))


def take():
    """What was asked for last, once."""
    global _asked
    taken, _asked = _asked, None
    return taken


def show_panel(asked):
    """Blender hides its panel after operators that are not in it."""
    if asked.shows_panel:
        once_drawn(lambda: _show_panel(asked))


def _show_panel(asked):
    window, area = _find(asked.place)
    if area is not None and area.spaces.active.show_region_hud:
        with bpy.context.temp_override(window=window, area=area):
            area.spaces.active.show_region_hud = True  # shows it anew


def _begin():
    _invoke(_asked.place, bpy.ops.uv.atlas_refine_again)


def _invoke(place, operator):
    window, area = _find(place)
    region = next((region for region in area.regions if region.type == "WINDOW"), None) if area else None
    with bpy.context.temp_override(window=window, area=area, region=region):
        if operator.poll():
            operator("INVOKE_DEFAULT")


def _place_of(context):
    return Place(context.window.as_pointer(), context.area.as_pointer() if context.area else 0)


def _find(place):
    """(window, area), of which the area may be None."""
    windows = list(bpy.context.window_manager.windows)
    window = next((window for window in windows if window.as_pointer() == place.window), windows[0])
    return window, next((area for area in window.screen.areas if area.as_pointer() == place.area), None)


def unregister():
    no_longer(_begin)
