"""The section --profile: where the processor's time of each run goes, by kind of work, and how its Newton steps did."""

import concurrent.futures
import json
import statistics
import tempfile
from pathlib import Path

import trees
from measure_file import refine

REPEATS = 3  # of which the shortest counts
# What the report calls each phase, in the order in which they are shown; "files" is reading and writing.
PHASES = {
    "order": "order", "factor": "factor", "solve": "solve", "assemble": "assembl", "contacts": "contact", "line_search": "search",
    "pack": "pack", "layout": "layout", "align": "align", "coarsen": "coarsen", "certificate": "certif", "input": "input",
    "files": "I/O", "other": "other",
}  # fmt: skip
NOTES = """Processor seconds of refine() and of files on one thread, each phase without those inside it; the shortest of 3 runs. order: of elimination, and
what the factor looks like; search: first flips and collisions, backtracking; its: Newton iterations of the result; steps: all under contact,
coarse and tried ones too, and the mean part of them that was taken; MB: the most memory of the process."""


def profile_of(report):
    """{phase: seconds} with that of files, and what else is shown."""
    profile = report["profile"]
    seconds = {**profile["phases"], "files": profile["files"]}
    return {
        "seconds": {phase: seconds[phase] for phase in PHASES},
        "iterations": report["iterations"],
        "steps": profile["steps"],
        "mean_step": profile["mean_step"],
    }


def total(row):
    return sum(row["seconds"].values())


def measured(program, folder, mesh, goal):
    """The shortest run's row; where one fails, why."""
    rows = []
    with tempfile.TemporaryDirectory(prefix="atlas-refine-bench-") as scratch:
        for _ in range(REPEATS):
            run = refine(program, mesh, Path(scratch) / "out.obj", goal)
            if not run.done:
                return {"file": f"{folder}/{mesh.stem}", "goal": goal.name, "reason": run.message}
            rows.append({**profile_of(run.report), "peak_mb": run.peak_bytes / 1e6})
    return {"file": f"{folder}/{mesh.stem}", "goal": goal.name, **min(rows, key=total)}


def header():
    return f"{'file':40} {'bound':14} {'s':>7} " + " ".join(f"{name:>7}" for name in PHASES.values()) + "  its steps  mean     MB"


def line(row):
    start = f"{row['file'][:40]:40} {row['goal']:14} "
    if "reason" in row:
        return start + row["reason"]
    cells = " ".join(f"{row['seconds'][phase]:7.2f}" for phase in PHASES)
    return (
        f"{start}{total(row):7.2f} {cells} {row['iterations']:4} {row['steps']:5} {row['mean_step']:5.2f} {row['peak_mb']:6.0f}"
    )


def sum_of(rows, goal):
    """All files of one goal as one row; the mean step is that of all steps, the memory that of the largest."""
    steps = sum(row["steps"] for row in rows)
    return {
        "file": f"all {len(rows)} files",
        "goal": goal,
        "seconds": {phase: sum(row["seconds"][phase] for row in rows) for phase in PHASES},
        "iterations": sum(row["iterations"] for row in rows),
        "steps": steps,
        "mean_step": sum(row["steps"] * row["mean_step"] for row in rows) / steps if steps else 0.0,
        "peak_mb": max(row["peak_mb"] for row in rows),
    }


def share_line(row):
    """What each phase takes of all, per cent."""
    whole = total(row) or 1.0
    return f"{'':40} {'%':14} {100:7.0f} " + " ".join(f"{100 * row['seconds'][phase] / whole:7.1f}" for phase in PHASES)


def summary(rows):
    lines = []
    for goal in dict.fromkeys(row["goal"] for row in rows):
        done = [row for row in rows if row["goal"] == goal and "reason" not in row]
        if done:
            all_of_them = sum_of(done, goal)
            median = statistics.median(total(row) for row in done)
            lines += [line(all_of_them), f"{share_line(all_of_them)}   median {median:.2f} s"]
    return lines


def run_profiles(build, asked, jobs, out):
    """`asked`: folder, file and goals of each. Prints a row for each run and the sums; how many runs failed."""
    print(NOTES + "\n\n" + header(), flush=True)
    rows = []
    with concurrent.futures.ProcessPoolExecutor(jobs) as pool:
        runs = [(folder, path, goal) for folder, path, goals in asked for goal in goals]
        tasks = [pool.submit(measured, build / trees.PROGRAM, *run) for run in runs]
        for task in tasks:
            rows.append(task.result())
            print(line(rows[-1]), flush=True)
            (out / "profile.json").write_text(json.dumps(rows, indent=1))
    print("\n" + "\n".join([header(), *summary(rows)]))
    return sum("reason" in row for row in rows)
