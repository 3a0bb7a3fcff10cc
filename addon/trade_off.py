# SPDX-License-Identifier: GPL-3.0-or-later
"""The outcomes between new seams and distortion that a search found, for the artist to pick one of."""

from dataclasses import dataclass

import bpy

from . import tasks
from .core.options import Options
from .core.summary import trade_off_lines

#: The Choice that the panel shows, None where there is none.
shown = None
_is_true, _in_doubt = False, False


@dataclass(frozen=True)
class Choice:
    options: Options
    lines: tuple  # of three words each, in the engine's order
    prints: tuple  # of the meshes that it is true of


def keywords(point=None):
    """The engine's, of a search for all outcomes. `point`: the one that is wanted; no search where it is below 0."""
    if point is None:
        return {"trade_off": True}
    return {"trade_off": True, "point": point} if point >= 0 else {}


class Search(tasks.Run):
    """Finds what there is to choose from and writes nothing."""

    writes = False

    def __init__(self, context, options, beside_window):
        super().__init__(context, options, beside_window, keywords())

    def _read(self, context, options):
        atlases = super()._read(context, options)
        if sum(atlas.request.box_count for atlas in atlases) > 1:
            self.problems.append(("Trade-off", "it is of one texture: select one object, or charts of one tile and material"))
            return []
        return atlases

    def finish(self):
        """The lines, which the panel shows from now on; none where `problems` says why."""
        global shown, _is_true, _in_doubt
        (atlas,) = self.atlases
        try:
            result = atlas.job.result()
        except tasks.FAILURES as error:
            self.problems.append((atlas.title, str(error)))
            return ()
        if not result.cuts:
            self.problems.append((atlas.title, "the map holds what is asked as it is, and there is nothing to choose"))
            return ()
        lines = tuple(trade_off_lines(result.cuts.trade_off))
        shown = Choice(atlas.options, lines, atlas.prints([part.uv_map for part in atlas.parts]))
        _is_true, _in_doubt = True, False
        return lines


def why_not(options):
    """Why nothing can be picked from `shown` with these options; empty where it can."""
    if options.for_trade_off() != shown.options:
        return "Other options now"
    return "" if _is_still_true() else "Undo brings it back"


def _is_still_true():
    global _is_true, _in_doubt
    if _in_doubt:
        _is_true, _in_doubt = tasks.is_true_of(shown.prints), False
    return _is_true


@bpy.app.handlers.persistent
def _forget(*_):
    global shown
    shown = None


@bpy.app.handlers.persistent
def _doubt(*_):
    global _in_doubt
    _in_doubt = True


@bpy.app.handlers.persistent
def _doubt_geometry(_scene, depsgraph):
    """What is no longer true only an undo makes so again: meshes that are worked on are not looked at again and again."""
    if shown is not None and _is_true and any(update.is_updated_geometry for update in depsgraph.updates):
        _doubt()


_HANDLERS = (("load_pre", _forget), ("undo_post", _doubt), ("redo_post", _doubt), ("depsgraph_update_post", _doubt_geometry))


def register():
    for name, function in _HANDLERS:
        getattr(bpy.app.handlers, name).append(function)


def unregister():
    _forget()
    for name, function in _HANDLERS:
        getattr(bpy.app.handlers, name).remove(function)
