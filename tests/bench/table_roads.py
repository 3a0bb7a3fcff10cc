"""The two roads side by side at equal bound, over the files on which both are valid and at it."""

import math
import statistics
from collections import defaultdict

LOW_DISTORTION = 1.2  # inputs above this E_d are left out, as in the other means
EQUAL = 5e-5  # E_d is told to four places
COLUMNS = f"  {'':22}{'files':>6}  {'road':12}{'E_d in':>8}{'E_d':>8}{'PE':>7}{'seams':>8}{'cpu s':>8}  lower E_d on"


def mean(values, form):
    finite = [value for value in values if math.isfinite(value)]
    return format(statistics.fmean(finite), form) if finite else "-"


def pairs_at(rows):
    """(squeeze, rectangles) of each file that has both."""
    by_file = defaultdict(dict)
    for row in rows:
        by_file[row.folder, row.file][row.cuts] = row
    return [(both[False], both[True]) for both in by_file.values() if len(both) == 2]


def road_line(folder, name, rows, lower):
    cells = (
        mean([row.e_d_in for row in rows], ".4f"),
        mean([row.e_d for row in rows], ".4f"),
        mean([row.pe for row in rows], ".3f"),
        mean([row.added_length if row.cuts else 0.0 for row in rows], "+.1%"),
        mean([row.cpu_seconds for row in rows], ".2f"),
    )
    numbers = "".join(f"{cell:>{width}}" for cell, width in zip(cells, (8, 8, 7, 8, 8), strict=True))
    return f"  {folder:22}{len(rows):>6}  {name:12}{numbers}  {lower} of {len(rows)}"


def of_those_that_are_cut(pairs):
    """Where seams were paid for, the distortion must be no more than without them."""
    cut = [pair for pair in pairs if pair[1].how == "cut"]
    if not cut:
        return []
    without, with_cuts = (statistics.fmean(row.e_d for row in rows) for rows in zip(*cut, strict=True))
    judged = "yes" if with_cuts <= without else "NO"
    return [f"    of the {len(cut)} that are cut: E_d {with_cuts:.4f} (at most the squeeze's {without:.4f}: {judged})"]


def folder_lines(folder, pairs):
    lower = [sum(one.e_d < other.e_d - EQUAL for one, other in ways) for ways in (pairs, [pair[::-1] for pair in pairs])]
    squeezed, cut = zip(*pairs, strict=True)
    lines = [road_line(folder, "squeeze", squeezed, lower[0]), road_line("", "rectangles", cut, lower[1])]
    return lines + of_those_that_are_cut(pairs)


def road_lines(rows):
    """A table for each bound that both roads were asked for; none where there is only one road."""
    out = []
    goals = dict.fromkeys(row.goal.removesuffix(" rect") for row in rows)
    for goal in goals:
        both = pairs_at([row for row in rows if row.goal.removesuffix(" rect") == goal])
        good = [pair for pair in both if all(row.ok and row.e_d_in < LOW_DISTORTION for row in pair)]
        if not good:
            continue
        folders = dict.fromkeys(pair[0].folder for pair in good)
        out += [
            f"two roads at {goal}: {len(good)} of {len(both)} files: both at the bound, E_d in below {LOW_DISTORTION}",
            COLUMNS,
        ]
        for folder in folders:
            out += folder_lines(folder, [pair for pair in good if pair[0].folder == folder])
        if len(folders) > 1:
            out += folder_lines("all", good)
    return out
