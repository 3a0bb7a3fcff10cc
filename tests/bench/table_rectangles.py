"""The benchmark's summary of results that cut, beside what the paper says of its own."""

import math

JUDGED = "0.80 free rect"  # where quality is asked for; validity, time and memory are asked for everywhere
LOW_DISTORTION = 1.2  # inputs above this E_d are left out of the mean growth
GROWTH_LIMIT = 0.001  # mean of (E_out - E_in) / E_in; the paper: 0.000533
LENGTH_FOLDER = "disk_deep"  # seams nearest to those of the paper's inputs
LENGTH_MEAN, LENGTH_MOST = 0.787, 1.68  # added seams / seams: the paper's figures
NETS_MOST = 0.1  # files with a safety net / files
TIME_LIMITS = ((21_500, 2.0), (70_500, 8.0), (101_000, 12.0))  # up to so many triangles, seconds on one thread
MEMORY_LIMIT = 2**30


def finite(values):
    return [value for value in values if math.isfinite(value)]


def mean(values):
    good = finite(values)
    return sum(good) / len(good) if good else math.nan


def most(values):
    return max(finite(values), default=math.nan)


def shown(value, form):
    return format(value, form) if math.isfinite(value) else "-"


def verdict(value, limit, form):
    """'0.0421 (at most 0.1000: yes)'."""
    if math.isnan(value):
        return "-"
    return f"{value:{form}} (at most {limit:{form}}: {'yes' if value <= limit else 'NO'})"


def only_shown(value, _, form):
    return shown(value, form)


def rectangle_lines(rows):
    """Every goal of results that cut."""
    out = []
    for goal in dict.fromkeys(row.goal for row in rows if row.cuts):
        at_goal = [row for row in rows if row.goal == goal]
        folders = "/".join(dict.fromkeys(row.folder for row in at_goal))
        out += [f"cuts at {goal}, {folders}", *goal_lines(at_goal)]
    return out


def goal_lines(rows):
    judge = verdict if rows[0].goal == JUDGED else only_shown
    done = [row for row in rows if row.ok]
    low = [row for row in done if row.e_d_in < LOW_DISTORTION]
    deep = [row for row in done if row.folder == LENGTH_FOLDER]
    nets = [row for row in rows if row.nets]
    return [
        f"  valid and at the bound: {len(done)} of {len(rows)}: {'yes' if len(done) == len(rows) else 'NO'}",
        f"  mean (E_out - E_in)/E_in, {len(low)} files with E_in < {LOW_DISTORTION}: "
        + judge(mean([r.growth for r in low]), GROWTH_LIMIT, ".4%")
        + f"; largest {shown(most([r.growth for r in low]), '.3%')}; mean E_2 {shown(mean([r.e_2 for r in low]), '.4f')}",
        f"  added seams, {LENGTH_FOLDER}: mean {judge(mean([r.added_length for r in deep]), LENGTH_MEAN, '.1%')}, "
        f"most {judge(most([r.added_length for r in deep]), LENGTH_MOST, '.0%')}; "
        f"N3 mean {shown(mean([r.small_charts for r in deep]), '.1f')}, SA mean {shown(mean([r.smallest for r in deep]), '.2%')}",
        f"  PE mean {shown(mean([r.pe for r in done]), '.1%')}",
        f"  files with a safety net: {len(nets)} of {len(rows)}: "
        + judge(len(nets) / len(rows), NETS_MOST, ".1%")
        + "".join(f"\n    {r.folder}/{r.file}: {'; '.join(r.fallbacks)}" for r in nets),
        *time_and_memory_lines(rows),
    ]


def time_and_memory_lines(rows):
    out, least = [], 0
    for up_to, limit in TIME_LIMITS:
        group = [row for row in rows if least < row.triangles <= up_to and math.isfinite(row.time)]
        least, low = up_to, least
        if not group:
            continue
        slowest, newtons = most([row.time for row in group]), most([row.newton_multiple for row in group])
        slow = [f"{row.folder}/{row.file} {row.time:.1f} s" for row in group if row.time > limit]
        out.append(
            f"  {low}-{up_to} triangles: at most {limit:g} s on {len(group) - len(slow)} of {len(group)}"
            f"; slowest {shown(slowest, '.2f')} s, most Newton iterations {shown(newtons, '.0f')}"
            + (": not " + ", ".join(slow) if slow else "")
        )
    peak = max(rows, key=lambda row: row.peak_bytes if math.isfinite(row.peak_bytes) else 0)
    return [
        *out,
        f"  peak memory: {verdict(peak.peak_bytes / 2**20, MEMORY_LIMIT / 2**20, '.0f')} MiB ({peak.folder}/{peak.file})",
    ]
