"""Seams where they are needed, beside none and rectangles: what boundary it takes to keep distortion within a limit."""

import concurrent.futures
import json
import math
import statistics
import tempfile
from dataclasses import replace
from pathlib import Path

import trees
from measure_file import Goal, measure_run

LOW_DISTORTION = 1.2  # inputs above this E_d are left out
SPARE = 1e-5  # of the limit, for what is told to few digits
MARGINS = (0.0, 0.01)  # the limits, above the input's E_d
SHARE = 0.25  # of the boundary that rectangles add, at most in the mean
MOST_TIMES = 4.0  # of a squeeze's processor time
HALF, MOST_GROWTH = 0.5, 0.08  # with the last margin: files that need no seam at least, mean growth at most


def goals(bound, aspect, options):
    base = Goal(bound, aspect)
    return [base, replace(base, seams="rectangles"), *(replace(base, seams="needed", options=options) for _ in MARGINS)]


def with_limit(goal, e_d_in, margin):
    return replace(goal, options=(*goal.options, "--max-distortion", repr(e_d_in + margin + SPARE)))


def rows_of(build, folder, mesh, bound, aspect, options):
    """The rows of one file: none, rectangles, needed at each margin."""
    squeeze, rectangles, *needed = goals(bound, aspect, options)
    with tempfile.TemporaryDirectory(prefix="atlas-refine-bench-") as scratch:
        run = [
            measure_run(build / trees.PROGRAM, folder, mesh, Path(scratch) / "0.obj", squeeze)[0],
            measure_run(build / trees.PROGRAM, folder, mesh, Path(scratch) / "1.obj", rectangles)[0],
        ]
        for k, (goal, margin) in enumerate(zip(needed, MARGINS, strict=True)):
            limited = with_limit(goal, run[0].e_d_in, margin) if run[0].ok else goal
            run.append(measure_run(build / trees.PROGRAM, folder, mesh, Path(scratch) / f"n{k}.obj", limited)[0])
    return run


def cell(row):
    if not row.ok:
        return f"{row.reason[:40] or 'not valid':>28}"
    return f"{row.e_d:8.4f}{100 * added(row):+8.1f} %{row.cpu_seconds:8.2f} s"


def added(row):
    """Boundary added, as a fraction of the input's seams."""
    return 0.0 if row.bl == row.bl_in else row.added_length


def header():
    names = ["none", "rectangles", *(f"needed, limit E_d in + {margin:g}" for margin in MARGINS)]
    return f"{'file':44}{'E_d in':>8}  " + "".join(f"{name:>30}" for name in names)


def line(rows):
    return f"{rows[0].folder + '/' + rows[0].file:44}{rows[0].e_d_in:8.4f}  " + "".join(f"{cell(row):>30}" for row in rows)


def judged(text, holds):
    return f"  {text}: {'yes' if holds else 'NO'}"


def mean(values):
    finite = [value for value in values if math.isfinite(value)]
    return statistics.fmean(finite) if finite else math.nan


def limit_line(low, k):
    """How the files keep one limit, and at what price."""
    good = [rows for rows in low if rows[k].ok]
    times = [rows[k].cpu_seconds / rows[0].cpu_seconds for rows in good]
    return (
        f"limit E_d in + {MARGINS[k - 2]:g}: kept on {len(good)} of {len(low)}; no seam on {uncut(good, k)}; "
        f"growth mean {mean(added(rows[k]) for rows in good):.1%}; "
        f"time / squeeze median {statistics.median(times) if times else math.nan:.1f}, "
        f"{sum(t <= MOST_TIMES for t in times)} of {len(times)} within {MOST_TIMES:g}"
    )


def uncut(files, k):
    return sum(rows[k].bl == rows[k].bl_in for rows in files)


def name_beside(rows):
    """Of a file, and by how much its rectangles miss the first limit."""
    missed = rows[1].e_d - rows[0].e_d_in - MARGINS[0]
    words = f" (whose rectangles miss the limit by {missed:.4f})" if missed > SPARE else ""
    return f"{rows[0].folder}/{rows[0].file}{words}"


def summary(files):
    """What is asked of all files together; of those whose input is not hopeless."""
    low = [rows for rows in files if rows[0].ok and rows[0].e_d_in < LOW_DISTORTION]
    both = [rows for rows in low if rows[1].ok and rows[2].ok and added(rows[1]) > 0]
    ratio = mean(added(rows[2]) for rows in both) / mean(added(rows[1]) for rows in both)
    more = [name_beside(rows) for rows in both if added(rows[2]) > added(rows[1])]
    loose = [rows for rows in low if rows[-1].ok]
    growth = mean(added(rows[-1]) for rows in loose)
    return [
        f"{len(files)} files, {len(low)} with E_d in < {LOW_DISTORTION}",
        *(limit_line(low, k) for k in range(2, 2 + len(MARGINS))),
        judged(f"boundary added / that of rectangles, {len(both)} files: {ratio:.3f}, at most {SHARE}", ratio <= SHARE),
        judged(f"more than rectangles on {len(more)} files {' '.join(more)}", not more),
        judged(f"at + {MARGINS[-1]:g} no seam on half", uncut(loose, -1) >= HALF * len(low)),
        judged(f"at + {MARGINS[-1]:g} growth at most {MOST_GROWTH:.0%}", growth <= MOST_GROWTH),
    ]


def run_needed(build, meshes, at, jobs, out):
    """All files; how many rows are not valid, or have no result."""
    print(header(), flush=True)
    files = []
    with concurrent.futures.ProcessPoolExecutor(jobs) as pool:
        tasks = [pool.submit(rows_of, build, folder, path, at.bound, at.aspect, at.options) for folder, path in meshes]
        for task in tasks:
            files.append(task.result())
            print(line(files[-1]), flush=True)
    lines = summary(files)
    out.mkdir(parents=True, exist_ok=True)
    (out / "needed.json").write_text(json.dumps([[row.as_json() for row in rows] for rows in files], indent=1))
    print("\n" + "\n".join(lines))
    return sum(not row.ok for rows in files for row in rows)
