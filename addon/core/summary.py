# SPDX-License-Identifier: GPL-3.0-or-later
"""A result in words, and its figures with the paper's symbols for those who want them."""

from dataclasses import dataclass

from .words import counted, named, plain

#: E_d up to which distortion is called so.
LOW, MODERATE = 1.05, 1.25
#: Digits that tell lines of the trade-off apart, besides those that each has.
_MOST_MORE = 3


@dataclass(frozen=True)
class Asked:
    """What a result is held against; 0 where nothing is asked."""

    use: float = 0.0
    max_distortion: float = 0.0
    max_stretch: float = 0.0
    boxes: str = "texture"  # what each of several is: a tile, a material


NOTHING_ASKED = Asked()


def headline(result, is_free=False, reached_beyond=False, asked=NOTHING_ASKED):
    """One line: texture use, distortion and seams, as "Texture use 48 % -> 80 %, distortion low (worst stretch 1.3), no new seams"."""
    seams = ", ".join(new_seams(result))
    if groups_left(result):
        text = f"{'; '.join(parts_held(result, asked))}; {distortion(measures_held(result))}, {seams}"
    else:
        text = f"{change_of_use(result, is_free, reached_beyond, asked)}, {distortion(result.after)}, {seams}"
    return "; missed: ".join(filter(None, (text, ", ".join(missed(result, asked)))))


def change_of_use(result, is_free, reached_beyond, asked):
    return f"{use(result.before, is_free, reached_beyond, asked)}{_became(result, asked)}"


def _became(result, asked):
    """`result`: or one of its groups."""
    return ", unchanged" if result.intervention == "unchanged" else f" -> {percent(result.after.pe_fixed_aspect, asked.use)}"


def parts_held(result, asked):
    """ "3 of 4 tiles reached 75 %", "1012 keeps its UVs (the bound 0.75 was not reached)"."""
    left = groups_left(result)
    reached = sum(group.bound_met for group in result.groups)
    yield f"{reached} of {counted(len(result.groups), asked.boxes)} {f'reached {100 * asked.use:g} %' if asked.use else 'refined'}"
    keep = "keeps its" if len(left) == 1 else "keep their"
    yield f"{named([name for name, _ in left])} {keep} UVs ({plain(left[0][1]).split('; ')[0]})"


def measures_held(result):
    """Those of the result; where tiles or materials keep their UVs those of the worst of the others."""
    held = [group.after for group in result.groups if not group.reason]
    return max(held, key=lambda measures: measures.distortion) if groups_left(result) else result.after


def uses_of_groups(result, asked):
    """(name, use) of each tile or material."""
    for group in result.groups:
        yield group.name, f"{percent(group.before.pe_fixed_aspect, asked.use)}{_became(group, asked)}"


def missed(result, asked):
    """What Best Effort, or an early end, leaves of what was asked for."""
    if result.bound_met:
        return
    groups = [(f"{group.name}: ", group) for group in result.groups if not group.reason]
    for name, held in groups or [("", result)]:
        now = held.after
        if now.pe_fixed_aspect < asked.use:
            yield f"{name}texture use {100 * asked.use:g} %, reached {percent(now.pe_fixed_aspect, asked.use)}"
        for what, limit, value in (
            ("distortion", asked.max_distortion, now.distortion),
            ("stretch", asked.max_stretch, now.stretch_99),
        ):
            if 0 < limit < value:
                yield f"{name}{what} {limit:g}, reached {_beyond(value, limit)}"


def _beyond(value, limit):
    """With as many digits as tell it from the limit."""
    return next((text for digits in range(2, 9) if float(text := f"{value:.{digits}f}") > limit), f"{value}")


def measured(measures, is_free=False, reaches_beyond=False, hidden=0, asked=NOTHING_ASKED):
    """`hidden`: faces that are left out."""
    text = f"{use(measures, is_free, reaches_beyond, asked)}, {distortion(measures)}, {counted(measures.chart_count, 'chart')}"
    return f"{text}, {counted(hidden, 'hidden face')} left out" if hidden else text


def use(measures, is_free, reaches_beyond, asked=NOTHING_ASKED):
    """What of the texture is covered says little where charts lie beside it, or on each other."""
    what = "Box use" if is_free else "Texture use"
    share = measures.pe_fixed_aspect
    covered = "over 100 % (charts overlap)" if share > 1 else percent(share, asked.use)
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
    seams = _told_apart(growth, [point.boundary_growth for point in points])
    distortions = _told_apart(lambda value, more: f"{value:.{3 + more}f}", [point.distortion for point in points])
    for point, new, value in zip(points, seams, distortions, strict=True):
        yield new if point.cuts else "none", value, counted(point.cuts, "cut")


def _told_apart(written, values):
    """`written`: (value, more digits) as a text; with as many more as no two different values read the same."""
    for more in range(_MOST_MORE + 1):
        texts = [written(value, more) for value in values]
        if len(set(texts)) == len(set(values)):
            break
    return texts


def growth(fraction, more=0):
    """The length of new seams as a part of the borders that there were; `more`: digits."""
    return f"+{100 * fraction:.{more}f} %" if fraction >= 0.01 else f"+{100 * fraction:.{2 + more}g} %"


def percent(fraction, asked=0.0):
    """Rounded, with as many digits as tell on which side of what was asked it is: a bound that is held must not read as missed, nor
    the other way round."""
    holds = fraction >= asked - 1e-9
    shown = (round(100 * fraction, digits) for digits in range(3))
    lowest = round(100 * asked, 4)
    otherwise = lowest if holds else int(1000 * fraction) / 10
    return f"{next((value for value in shown if (value >= lowest) == holds), otherwise):g} %"


def what_was_done(result, asked=NOTHING_ASKED):
    """A word for the panel's first line."""
    if result.ended == "stopped" and result.intervention == "unchanged":
        return "Stopped before anything better was found: nothing changed"
    return {
        "unchanged": "Already there: nothing changed",
        "moved": "Charts moved, shapes kept",
        "squeezed": "Charts moved and bent",
        "cut": "Charts cut, moved and bent",
    }[result.intervention] + _what_was_missed(result, asked)


def _what_was_missed(result, asked):
    if result.bound_met:
        return ""
    if result.ended == "stopped":
        return "; stopped early"
    if groups_left(result):
        return "; " + "; ".join(parts_held(result, asked))
    if 0 < asked.max_distortion < result.after.distortion:
        return "; the distortion stays above its limit"
    if 0 < asked.max_stretch < result.after.stretch_99:
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


def _figure(value, decimals):
    """NaN is of nothing: no chart takes part."""
    return "-" if value != value else f"{value:.{decimals}f}"


def _percent_of_diagonal(fraction):
    return "-" if fraction == float("inf") else f"{100 * fraction:.2f} %"
