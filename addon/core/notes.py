# SPDX-License-Identifier: GPL-3.0-or-later
"""What an artist should know besides the figures, one line each."""

import re
from collections import Counter

import numpy as np

from .words import counted, named, plain

_MENDED_OF = re.compile(r"\b(\d+) (edge|hole)s?\b")
_NUMBERED = re.compile(r"\bcharts? (\d+(?:, \d+)*)(?: and (\d+)\b)?")
_COUNTED = re.compile(r"\b(\d+) charts\b")
_STACKED = "on another chart of the same shape, kept there"


def notes(result, objects=()):
    """`objects`: of each chart, where there are several; they are named."""
    for what, charts, faces in _mended(result.repairs):
        of_faces = f" ({counted(faces, 'face')})" if faces else ""
        said = what if len(charts) == 1 else what.replace("itself", "themselves").replace("its shape", "their shapes")
        yield f"{counted(len(charts), 'chart')}: {said}{of_faces}{_where(charts, objects)}"
    for text in (*result.fallbacks, *result.warnings):
        yield f"{plain(text)}{_where(_charts_of(text, result.charts), objects)}"


def objects_of_charts(face_charts, first_faces, names):
    """The name of each chart's object: object k has the faces from first_faces[k] on."""
    _, first = np.unique(face_charts, return_index=True)
    return tuple(names[k] for k in np.searchsorted(first_faces, first, side="right") - 1)


def joined(pairs):
    """Of (name, text) pairs: "name: text" once for each text."""
    names = {}
    for name, text in pairs:
        names.setdefault(text, {})[name] = None
    return [f"{named(list(of_text))}: {text}" for text, of_text in names.items()]


def _mended(repairs):
    """(what, charts, number of faces) of each kind; kinds that differ in what they count are one."""
    charts, faces, counts = {}, Counter(), {}
    for repair in repairs:
        kind = _MENDED_OF.sub(lambda found: f"# {found.group(2)}s", repair.what)
        charts.setdefault(kind, set()).update(repair.charts)
        faces[kind] += len(repair.faces)
        counts.setdefault(kind, Counter()).update({noun: int(count) for count, noun in _MENDED_OF.findall(repair.what)})
    for kind, of_kind in charts.items():
        what = re.sub("# (edge|hole)s", lambda found, kind=kind: counted(counts[kind][found.group(1)], found.group(1)), kind)
        yield what, sorted(of_kind), faces[kind]


def _charts_of(text, charts):
    """Those that the engine numbers in a message; many it only counts: what became of them tells which."""
    found = _NUMBERED.search(text)
    if found:
        return [int(number) for number in (*found.group(1).split(", "), found.group(2)) if number]
    found = _COUNTED.search(text)
    alike = [k for k, chart in enumerate(charts) if chart.reason and chart.reason in text]
    if _STACKED in text:
        alike = [k for k, chart in enumerate(charts) if chart.fate == "stacked"]
    return alike if found and int(found.group(1)) == len(alike) else []


def _where(charts, objects):
    """ " (Crate)", " (Crate: 2, Barrel: 1)"."""
    of_charts = Counter(objects[chart] for chart in charts if chart < len(objects)).most_common()
    if len(of_charts) < 2:
        return "".join(f" ({name})" for name, _ in of_charts)
    return f" ({named([f'{name}: {count}' for name, count in of_charts])})"
