# SPDX-License-Identifier: GPL-3.0-or-later
"""A result in words, and its figures with the paper's symbols for those who want them."""

from collections import Counter

from .words import counted, plain

#: E_d up to which distortion is called so.
LOW, MODERATE = 1.05, 1.25


def headline(result, is_free=False, reached_beyond=False):
    """One line: texture use, distortion and seams, as "Texture use 48 % -> 80 %, distortion low (worst stretch 1.3), no new seams"."""
    after = result.after
    now = percent(after.pe_fixed_aspect, down=True)
    return f"{use(result.before, is_free, reached_beyond)} -> {now}, {distortion(after)}, {', '.join(new_seams(result))}"


def measured(measures, is_free=False, reaches_beyond=False, hidden=0):
    """`hidden`: faces that are left out."""
    text = f"{use(measures, is_free, reaches_beyond)}, {distortion(measures)}, {counted(measures.chart_count, 'chart')}"
    return f"{text}, {counted(hidden, 'hidden face')} left out" if hidden else text


def use(measures, is_free, reaches_beyond):
    """What of the texture is covered says little where charts lie beside it, or on each other."""
    what = "Box use" if is_free else "Texture use"
    covered = "over 100 % (charts overlap)" if measures.pe_fixed_aspect > 1 else percent(measures.pe_fixed_aspect)
    return f"{what} {covered}{' (reaching beyond it)' if reaches_beyond else ''}"


def distortion(measures):
    value = measures.distortion
    if value != value or not measures.chart_count:
        return "no chart takes part"
    word = "low" if value <= LOW else "moderate" if value <= MODERATE else "high"
    return f"distortion {word} (worst stretch {measures.stretch_max:.1f})"


def in_parts(text):
    """What is in brackets at the end by itself, for a narrow sidebar."""
    return text.removesuffix(")").split(" (")


def new_seams(result):
    """In parts that a narrow sidebar has room for, one a line."""
    if not result.added_seams:
        yield "no new seams"
        return
    edges = counted(result.added_seams, "new seam edge")
    yield f"{counted(result.cuts.cuts, 'cut')}, {edges}" if result.cuts and result.cuts.cuts else edges
    if result.boundary_growth > 0:  # closed charts that were opened had no borders
        yield f"{growth(result.boundary_growth)} of the charts' borders"


def trade_off_lines(points):
    """(new seams, distortion, cuts) of each outcome that is worth a choice."""
    for point in points:
        yield growth(point.boundary_growth) if point.cuts else "none", f"{point.distortion:.3f}", counted(point.cuts, "cut")


def growth(fraction):
    """The length of new seams as a part of the borders that there were."""
    return f"+{100 * fraction:.0f} %" if fraction >= 0.01 else f"+{100 * fraction:.2g} %"


def percent(fraction, down=False):
    """A bound of 80 % that is held must not read as 79 %, nor what is below it as held."""
    value = 100 * fraction
    return f"{int(value + 1e-6) if down else round(value)} %"


def what_was_done(result, max_distortion=0.0, max_stretch=0.0):
    """A word for the panel's first line; the limits are those that were asked for, 0 where none was."""
    if result.ended == "stopped" and result.intervention == "unchanged":
        return "Stopped before anything better was found: nothing changed"
    return {
        "unchanged": "Already there: nothing changed",
        "moved": "Charts moved, shapes kept",
        "squeezed": "Charts moved and bent",
        "cut": "Charts cut, moved and bent",
    }[result.intervention] + _what_was_missed(result, max_distortion, max_stretch)


def _what_was_missed(result, max_distortion, max_stretch):
    if result.bound_met:
        return ""
    if result.ended == "stopped":
        return "; stopped early"
    if 0 < max_distortion < result.after.distortion:
        return "; the distortion stays above its limit"
    if 0 < max_stretch < result.after.stretch_99:
        return "; the stretch stays above its limit"
    return "; the wanted use was not reached"


def figures(result, face_count):
    """(name, before, after) rows for Details; short names, for the column is narrow. `face_count` is the input's."""
    before, after = result.before, result.after
    return [
        ("PE", f"{before.pe_fixed_aspect:.3f}", f"{after.pe_fixed_aspect:.3f}"),
        ("E_d", *(_figure(m.distortion, 4) for m in (before, after))),
        ("Stretch", *(_figure(m.stretch_99, 3) for m in (before, after))),
        ("Gap", _percent_of_diagonal(before.gap_between), _percent_of_diagonal(after.gap_between)),
        ("Charts", str(before.chart_count), str(after.chart_count)),
        ("Seams", str(before.seam_edges), str(after.seam_edges)),
        ("BL", f"{before.boundary_length:.3f}", f"{after.boundary_length:.3f}"),
        ("Faces", str(face_count), str(faces_after(result, face_count))),
    ]


def nothing_takes_part(result):
    """Every chart was left as it was: the engine, which had nothing to do, calls the bound met."""
    return result.after.chart_count == 0


def groups_left(result):
    """(name, why) of tiles and materials that keep their UVs."""
    return [(group.name, group.reason) for group in result.groups if group.reason]


def faces_after(result, face_count):
    return face_count if result.cut is None else len(result.cut.face_sources)


def notes(result):
    """What an artist should know besides the figures, one line each."""
    charts, faces = Counter(), Counter()
    for repair in result.repairs:
        charts[repair.what] += len(repair.charts)
        faces[repair.what] += len(repair.faces)
    for what, count in charts.items():
        of_faces = f" ({counted(faces[what], 'face')})" if faces[what] else ""
        said = what if count == 1 else what.replace("itself", "themselves").replace("its shape", "their shapes")
        yield f"{counted(count, 'chart')}: {said}{of_faces}"
    yield from (plain(text) for text in (*result.fallbacks, *result.warnings))


def _figure(value, decimals):
    """NaN is of nothing: no chart takes part."""
    return "-" if value != value else f"{value:.{decimals}f}"


def _percent_of_diagonal(fraction):
    return "-" if fraction == float("inf") else f"{100 * fraction:.2f} %"
