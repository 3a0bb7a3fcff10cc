#!/usr/bin/env python3
"""The benchmark: every file of the test meshes at every bound, checked by an independent program, as one table.

Prints a row for each file and bound as soon as it is known, then summaries; writes bench.json and bench.md. A file that fails is a
row with the program's own reason. Exit code 0 where every row is ok (or nothing of the asked section went wrong), else 1.

Meshes: the folder named by ATLAS_REFINE_MESHES, else what ../shared/data/unpack.sh unpacks.
"""

import argparse
import concurrent.futures
import fnmatch
import json
import os
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import studies
import table
from bad_input import bad_input_lines
from measure_file import Goal, Row, count_triangles, measure_file, outputs_differ

ROOT = Path(__file__).resolve().parents[2]
FOLDERS = {
    "disk": "disk",
    "disk_deep": "disk_deep",
    "atlas-clean": "uv/atlas-clean",
    "atlas-nondisk-charts": "uv/atlas-nondisk-charts",
}
REQUIRED_FOLDERS = list(FOLDERS)[:3]
GOALS = [Goal(0.80), Goal(0.90), Goal(0.80, "square"), Goal(0.85), Goal(0.95)]
GOALS_OF_CUTS = {"": [Goal(0.80)], "disk_deep": [Goal(0.85), Goal(0.90), Goal(0.80, "square")]}  # for every folder; for one
QUICK_TRIANGLES = 6000


def mesh_root():
    named = os.environ.get("ATLAS_REFINE_MESHES")
    unpack = ROOT.parent / "shared" / "data" / "unpack.sh"
    if not named and not unpack.exists():
        sys.exit(f"bench: no meshes: ATLAS_REFINE_MESHES is not set, and there is no {unpack}")
    if not named:
        named = subprocess.run(["bash", unpack], capture_output=True, text=True, check=True).stdout.split("\n")[-2]
    if not (Path(named) / "disk").is_dir():
        sys.exit(f"bench: {named} holds no disk/")
    return Path(named)


def goal(text):
    bound, _, aspect = text.partition(":")
    return Goal(float(bound), aspect or "free")


def goals_of(arguments, folder):
    """What is asked of the files of a folder; results with and without cuts of one bound beside each other."""
    cuts = GOALS_OF_CUTS[""] + GOALS_OF_CUTS.get(folder, [])
    asked = {"none": arguments.bounds or GOALS, "rectangles": arguments.bounds or cuts}
    goals = [replace(goal, seams=seams) for seams in arguments.seams for goal in asked[seams]]
    order = [(goal.bound, goal.aspect) for goal in [*(arguments.bounds or GOALS), *cuts]]
    return sorted(goals, key=lambda goal: (order.index((goal.bound, goal.aspect)), goal.cuts))


def meshes(arguments, folders):
    """(folder, path), small files first within each folder."""
    root = mesh_root()
    for folder in folders:
        found = [path for path in (root / FOLDERS[folder]).glob("*.obj") if fnmatch.fnmatch(path.stem, arguments.files)]
        for path in sorted(found, key=lambda path: (path.stat().st_size, path.name)):
            if not arguments.quick or count_triangles(path) <= QUICK_TRIANGLES:
                yield folder, path


def guarded(work, rows_of_failure):
    try:
        return work()
    except Exception as error:  # one file must not end the table
        return rows_of_failure(f"bench: {type(error).__name__}: {error}")


def measure_guarded(build, folder, path, goals):
    def failed(reason):
        return [Row(folder, path.stem, goal.name, goal.seams, count_triangles(path), reason=reason) for goal in goals]

    return guarded(lambda: measure_file(build, folder, path, goals), failed)


def run_table(arguments, out):
    rows = []
    print(table.header(), flush=True)
    with concurrent.futures.ProcessPoolExecutor(arguments.jobs) as pool:
        tasks = [
            pool.submit(measure_guarded, arguments.build, folder, path, goals_of(arguments, folder))
            for folder, path in meshes(arguments, arguments.folders)
        ]
        for task in tasks:
            for row in task.result():
                rows.append(row)
                print(table.line(row), flush=True)
            (out / "bench.json").write_text(json.dumps([row.as_json() for row in rows], indent=1))
    order = [goal.name for folder in FOLDERS for goal in goals_of(arguments, folder)]
    rows.sort(key=lambda row: order.index(row.goal))
    lines = table.summary(rows)
    (out / "bench.md").write_text(table.markdown(rows, lines))
    print("\n" + table.NOTES + "\n\n" + "\n".join(lines))
    return sum(not row.ok for row in rows)


def run_determinism(arguments):
    """The required folders at the first bound: two runs with one seed, and two threads."""
    return sum(determinism_at(replace((arguments.bounds or GOALS)[0], seams=seams), arguments) for seams in arguments.seams)


def determinism_at(at, arguments):
    wrong, count, longest = 0, 0, (0.0, "")
    for folder, path in meshes(arguments, [f for f in arguments.folders if f in REQUIRED_FOLDERS]):
        difference, seconds = guarded(lambda path=path: outputs_differ(arguments.build, path, at), lambda why: (why, [0.0]))
        count, wrong = count + 1, wrong + bool(difference)
        longest = max(longest, (seconds[-1], f"{folder}/{path.stem}"))
        print(f"{folder}/{path.stem:40} {difference or 'same bits'}", flush=True)
    print(
        f"determinism at {at.name}: same bits from two runs and from 1 and 2 threads on {count - wrong} of {count} files; "
        f"longest with 2 threads, files included: {longest[0]:.1f} s ({longest[1]})"
    )
    return wrong


def run_bad_input(arguments):
    lines, wrong = bad_input_lines(arguments.build / "atlas-refine")
    print("\n".join(lines))
    print(f"bad input: {len(lines) - wrong} of {len(lines)} as asked")
    return wrong


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--folders", nargs="+", choices=FOLDERS, default=list(FOLDERS))
    parser.add_argument("--bounds", nargs="+", type=goal, help="0.8, 0.8:square, 0.8:16:9, ... [what is asked of the folder]")
    parser.add_argument("--seams", nargs="+", choices=["none", "rectangles"], default=["none", "rectangles"])
    parser.add_argument("--files", default="*", help="pattern of file names, without .obj")
    parser.add_argument("--jobs", type=int, default=1, help="files at a time; timings are honest only with 1")
    parser.add_argument("--quick", action="store_true", help=f"only files of at most {QUICK_TRIANGLES} triangles")
    parser.add_argument("--determinism", action="store_true", help="instead: the same bits from 2 runs and from 1 and 2 threads")
    parser.add_argument("--bad-input", action="store_true", help="instead: exit codes and messages of bad input")
    parser.add_argument("--study", choices=studies.NAMES, help="instead: one of the paper's studies, its figures beside ours")
    parser.add_argument("--build", type=Path, default=ROOT / "build")
    parser.add_argument("--out", type=Path, default=ROOT / "out" / "bench")
    arguments = parser.parse_args()
    arguments.build = arguments.build.resolve()
    for name in ("atlas-refine", "atlas_refine_bench"):
        if not (arguments.build / name).is_file():
            sys.exit(f"bench: {arguments.build / name} is not built; run ./dev build")
    if arguments.bad_input:
        return 1 if run_bad_input(arguments) else 0
    if arguments.determinism:
        return 1 if run_determinism(arguments) else 0
    arguments.out.mkdir(parents=True, exist_ok=True)
    if arguments.study:
        return (
            1 if studies.run_study(arguments.study, arguments, lambda folder: (p for _, p in meshes(arguments, [folder]))) else 0
        )
    return 1 if run_table(arguments, arguments.out) else 0


if __name__ == "__main__":
    sys.exit(main())
