# SPDX-License-Identifier: GPL-3.0-or-later
"""The outcomes between new seams and distortion that a search found, for the artist to pick one of."""

from dataclasses import dataclass

import bpy

from . import drawing, tasks
from .changes import Watch, no_longer, once_drawn
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


#: The engine's keyword for a search for all outcomes.
SEARCH = {"trade_off": True}


def picked(options, point):
    """(options, keywords) of a run: None asks for what the limits choose, a number for that line of the trade-off."""
    if point is None:
        return options, {}
    return options.for_trade_off(), {**SEARCH, "point": point}


class Search(tasks.Run):
    """Finds what there is to choose from and writes nothing."""

    writes = False
    told = ()  # of the input: what is mended in every outcome, whose seams are none of the cuts that the lines count

    def __init__(self, context, options, beside_window):
        super().__init__(context, options, SEARCH, beside_window)

    def _read(self, context, options):
        atlases = yield from super()._read(context, options)
        if sum(len(atlas.request.box_names) for atlas in atlases) > 1:
            self.problems.append(("Trade-off", "it is of one texture: select one object, or charts of one tile and material"))
            return []
        return atlases

    def _write(self):
        """The lines, which the panel shows from now on; none where `problems` says why."""
        global shown, _is_true, _in_doubt
        (atlas,) = self.atlases
        try:
            result = atlas.job.result()
        except tasks.FAILURES as error:
            self.problems.append((atlas.title_of(error), atlas.words_of(tasks.why(error))))
            return
        if not result.cuts or len(result.cuts.trade_off) == 1:
            self.problems.append((atlas.title, "no cut spares distortion, and there is nothing to choose"))
            return
        self.told = atlas.mended(result)
        prints = yield atlas.prints
        self._written = tuple(trade_off_lines(result.cuts.trade_off))
        shown = Choice(atlas.options, self._written, prints)
        _is_true, _in_doubt = True, False


def why_not(options):
    """Why nothing can be picked from `shown` with these options; empty where it can."""
    if options.for_trade_off() != shown.options:
        return "Other options now"
    if _in_doubt:
        once_drawn(look_again)
    return "" if _is_true else "Undo brings it back"


def look_again():
    """At the meshes."""
    global _is_true, _in_doubt
    if shown is not None and _in_doubt:
        _is_true, _in_doubt = tasks.is_true_of(shown.prints), False
        drawing.redraw_panels(bpy.context)


def _forget():
    global shown
    shown = None


def _doubt():
    global _in_doubt
    _in_doubt = True


#: What is no longer true only an undo makes so again: meshes that are worked on are not looked at again and again.
_watch = Watch(_forget, _doubt, is_needed=lambda: shown is not None and _is_true)


def register():
    _watch.register()


def unregister():
    no_longer(look_again)
    _forget()
    _watch.unregister()
