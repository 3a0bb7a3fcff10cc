"""The benchmark's rows and summaries as text."""

import math
import statistics

from table_rectangles import rectangle_lines
from table_roads import road_lines

LOW_DISTORTION = 1.2  # inputs above this E_d are left out of the means
EXTRA_LIMIT = {"disk": 0.010, "disk_deep": 0.013, "atlas-clean": 0.007}  # mean extra E_d at 0.80 free
TIME_LIMITS = ((21_500, 3.0), (101_000, 20.0))  # up to so many triangles, seconds on one thread from a valid start
NEWTON_TRIANGLES = 4000  # below, an iteration with stock Eigen takes next to no time
LONGEST_RUN_S = 60


def text(value, form):
    return "-" if value is None or (isinstance(value, float) and math.isnan(value)) else format(value, form)


COLUMNS = (
    ("file", lambda r: f"{r.folder}/{r.file}"[:48], "48"),
    ("bound", lambda r: r.goal, "16"),
    ("tris", lambda r: str(r.triangles), ">7"),
    ("CN in", lambda r: str(r.charts_in), ">5"),
    ("CN", lambda r: str(r.charts), ">4"),
    ("SA %", lambda r: text(100 * r.smallest, ".2f"), ">6"),
    ("N3", lambda r: str(r.small_charts), ">3"),
    ("how", lambda r: r.how, "9"),
    ("emb", lambda r: str(r.re_embedded), ">3"),
    ("valid", lambda r: "yes" if r.valid else "NO", "5"),
    ("met", lambda r: "yes" if r.met else "NO", "3"),
    ("nets", lambda r: str(r.nets), ">4"),
    ("BL+ %", lambda r: text(100 * r.added_length, "z.1f"), ">6"),
    ("PE in", lambda r: text(r.pe_in, ".3f"), ">6"),
    ("PE", lambda r: text(r.pe, ".4f"), ">6"),
    ("E_d in", lambda r: text(r.e_d_in, ".4f"), ">8"),
    ("E_d", lambda r: text(r.e_d, ".4f"), ">7"),
    ("dE %", lambda r: text(100 * r.growth, ".3f"), ">7"),
    ("extra", lambda r: text(r.extra, ".4f"), ">7"),
    ("str99", lambda r: text(r.stretch_99, ".2f"), ">6"),
    ("strmax", lambda r: text(r.stretch_max, ".2f"), ">7"),
    ("gap %", lambda r: text(100 * r.gap, ".3f"), ">6"),
    ("within", lambda r: text(100 * r.gap_within, ".3f"), ">6"),
    ("iter", lambda r: str(r.iterations), ">5"),
    ("s", lambda r: text(r.seconds, ".2f"), ">6"),
    ("cpu s", lambda r: text(r.cpu_seconds, ".2f"), ">6"),
    ("xNewton", lambda r: text(r.newton_multiple, ".0f"), ">7"),
    ("MiB", lambda r: text(r.peak_bytes / 2**20, ".0f"), ">5"),
    ("reason", lambda r: r.reason, ""),
)
NOTES = """emb: charts that overlapped themselves and were embedded anew. nets: how often something else was done than was tried first.
BL+ %: seams added / seams before. dE %: (E_d - E_d in) / E_d in. extra: E_d over the charts' own optimum (the engine without a bound), of
results without a cut. gap %, within: per cent of the box diagonal, guaranteed between charts, measured within. s: inside refine(), one
thread. cpu s: processor time of the whole process, files included. xNewton: the lesser of both over one Newton iteration with stock Eigen
on the same charts. MiB: peak memory of the process."""


def header():
    return "  ".join(f"{name:{form}}" for name, _, form in COLUMNS)


def line(row):
    return "  ".join(f"{cell(row):{form}}" for _, cell, form in COLUMNS).rstrip()


def markdown(rows, summary_lines):
    out = ["| " + " | ".join(name for name, _, _ in COLUMNS) + " |", "|" + "---|" * len(COLUMNS)]
    out += ["| " + " | ".join(cell(row).replace("|", "/") for _, cell, _ in COLUMNS) + " |" for row in rows]
    return "\n".join([*out, "", NOTES, "", "```", *summary_lines, "```", ""])


def mean(values):
    finite = [value for value in values if math.isfinite(value)]
    return statistics.fmean(finite) if finite else math.nan


def median(values):
    finite = [value for value in values if math.isfinite(value)]
    return statistics.median(finite) if finite else math.nan


def group_line(rows):
    """Counts and means of the rows of one folder (or of several) at one bound."""
    low = [row for row in rows if row.ok and row.e_d_in < LOW_DISTORTION]
    squeezed = [row for row in low if row.how == "squeezed"]
    how = {name: sum(row.how == name for row in rows) for name in ("unchanged", "moved", "squeezed", "cut", "failed")}
    return (
        f"ok {sum(row.ok for row in rows)} of {len(rows)} ("
        + ", ".join(f"{count} {name}" for name, count in how.items() if count)
        + f"); extra E_d mean {text(mean([r.extra for r in low]), '.4f')} ({len(low)} files)"
        + f", squeezed {text(mean([r.extra for r in squeezed]), '.4f')} ({len(squeezed)})"
        + f", largest {text(max((r.extra for r in low if math.isfinite(r.extra)), default=math.nan), '.4f')}"
        + f"; E_d {text(mean([r.e_d_in for r in low]), '.4f')} -> {text(mean([r.e_d for r in low]), '.4f')}"
        + f"; stretch 99 % {text(mean([r.stretch_99 for r in low]), '.3f')}"
        + f"; gap kept {sum(row.ok and row.gap >= 0.0025 for row in rows)} of {len(rows)}"
        + f"; slowest {text(max((r.time for r in rows if math.isfinite(r.time)), default=math.nan), '.1f')} s"
    )


def summary(rows):
    """Per bound and folder, then what is required of them, then every failure."""
    out = []
    for goal in dict.fromkeys(row.goal for row in rows):
        at_goal = [row for row in rows if row.goal == goal]
        out.append(f"bound {goal}")
        for folder in dict.fromkeys(row.folder for row in at_goal):
            out.append(f"  {folder:22} {group_line([row for row in at_goal if row.folder == folder])}")
        required = [row for row in at_goal if row.folder in EXTRA_LIMIT]
        if required and (len(required) < len(at_goal) or len({row.folder for row in required}) > 1):
            out.append(f"  {'/'.join(EXTRA_LIMIT)}: ok {sum(row.ok for row in required)} of {len(required)}")
    judged = [row for row in rows if row.folder in EXTRA_LIMIT] or rows
    out += ["", *time_lines(rows), *extreme_lines(rows), "", *rectangle_lines(judged), "", *road_lines(rows)]
    failures = [row for row in rows if not row.ok]
    out += ["", f"failures: {len(failures)} of {len(rows)}"]
    out += [f"  {row.folder}/{row.file} at {row.goal}: {row.reason or 'seams added'}" for row in failures]
    return out


def time_lines(rows):
    out = []
    least = 0
    for most, limit in TIME_LIMITS:
        group = [r for r in rows if r.goal == "0.80 free" and not r.re_embedded and r.ok and least < r.triangles <= most]
        least, low = most, least
        if not group:
            continue
        slow = [f"{r.folder}/{r.file} {r.time:.1f} s" for r in group if r.time > limit]
        out.append(
            f"0.80 free, valid start, {low}-{most} triangles: at most {limit:g} s on {len(group) - len(slow)} of {len(group)}"
            + (": not " + ", ".join(slow) if slow else "")
            + f"; median {text(median([r.time for r in group]), '.2f')} s"
            + f", {text(median([r.newton_multiple for r in group if r.triangles >= NEWTON_TRIANGLES]), '.0f')} Newton iterations"
        )
    long = [f"{r.folder}/{r.file} at {r.goal} {r.time:.0f} s" for r in rows if r.time > LONGEST_RUN_S]
    out.append(f"over {LONGEST_RUN_S} s on one thread: {len(long)}" + (": " + ", ".join(long) if long else ""))
    return out


def extreme_lines(rows, count=5):
    done = [row for row in rows if row.ok]
    slowest = sorted((r for r in done if math.isfinite(r.time)), key=lambda r: -r.time)[:count]
    dearest = sorted((r for r in done if math.isfinite(r.extra)), key=lambda r: -r.extra)[:count]
    nearer = [r for r in rows if r.nearer_within]
    return [
        f"borders of one chart nearer than the gap and than in the input, or re-embedded so: {len(nearer)}"
        + "".join(f"\n  {r.folder}/{r.file} at {r.goal}: {text(100 * r.gap_within, '.3f')} %" for r in nearer),
        "slowest: " + ", ".join(f"{r.folder}/{r.file} at {r.goal} {r.time:.1f} s" for r in slowest),
        "largest extra E_d: " + ", ".join(f"{r.folder}/{r.file} at {r.goal} {r.extra:.4f}" for r in dearest),
    ]
