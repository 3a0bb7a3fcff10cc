# SPDX-License-Identifier: GPL-3.0-or-later
"""The engine's messages as an artist reads them: counts, not the numbers of charts."""

import re
import textwrap

#: Of the sidebar, at a scale of 1: its letters in the mean, what its margins and tabs take, an icon.
_LETTER_PX, _MARGINS_PX, ICON_PX = 6.2, 48, 20
_LEAST_LETTERS = 16
_CHARTS = re.compile(r"\bcharts (\d+(?:, \d+)*)\b(?: and (\d+)\b)?")
_CHART = re.compile(r"(?:\bface (\d+) of )?\bchart \d+\b")
#: What the panel calls otherwise, and what is said otherwise to somebody who sees Blender's own triangles.
_WORDS = {
    "packing efficiency": "texture use",
    "E_d": "distortion",
    " charts at the bound ": " charts at a texture use of ",
    "charts of several groups": "charts of several materials",
}
_GAP = re.compile(r"\bgap\b")
_NOT_CONVEX = re.compile(r"(not convex in the UV map), valid only where divided as here; \d+ of them would be flipped as a fan")
_GROWTH = re.compile(r"\ba boundary growth of ([0-9.e+-]*[0-9])")
_OBJECT = re.compile(r"(^|: )object '.*?': ")
#: Of many names so many are told.
_MOST_NAMES = 3


def plain(message):
    """ "charts 3, 5: mirrored" -> "2 charts: mirrored"; "chart 7 has no area" -> "1 chart has no area"."""
    message = _OBJECT.sub(r"\1", message)
    message = _CHARTS.sub(lambda found: f"{found.group(1).count(',') + 1 + bool(found.group(2))} charts", message)
    message = _GROWTH.sub(lambda found: f"new seams of {100 * float(found.group(1)):.3g} % of the charts' borders", message)
    for said, word in _WORDS.items():
        message = message.replace(said, word)
    message = _GAP.sub("margin", message)
    message = _NOT_CONVEX.sub(r"\1: to a program that divides faces otherwise than Blender they may be flipped", message)
    return _CHART.sub(lambda found: f"face {found.group(1)}" if found.group(1) else "1 chart", message)


def titled(title, text):
    """The text with what it is about before it, unless it begins so."""
    return text if text.startswith(f"{title}: ") else f"{title}: {text}"


def counted(count, one):
    return f"{count} {one if count == 1 else one + 's'}"


def named(names):
    """ "A, B and C"; of many the first, "A, B, C and 37 more"."""
    shown, others = list(names[:_MOST_NAMES]), len(names) - _MOST_NAMES
    last = [f"{others} more"] if others > 0 else shown[1:][-1:]
    first = shown if others > 0 else shown[: len(shown) - len(last)]
    return " and ".join(filter(None, (", ".join(first), *last)))


def phase(stage):
    """A stage of the engine for the progress bar."""
    return {
        "input": "reading",
        "repair": "mending",
        "align": "straightening",
        "layout": "planning cuts",
        "pack": "packing",
        "squeeze": "bending",
        "reduce": "relaxing",
        "certify": "checking",
        "compare": "comparing",
        "write": "writing",
    }.get(stage, stage)


def lines_of(text, width_px):
    """A text broken at its spaces into lines that a region of that width, in pixels at a scale of 1, has room for."""
    return textwrap.wrap(text, max(_LEAST_LETTERS, int((width_px - _MARGINS_PX) / _LETTER_PX)))
