#!/usr/bin/env python3
"""The benchmark: every file of the test meshes at every bound, checked by an independent program, as one table.

Prints a row for each file and bound as soon as it is known, then summaries; writes bench.json and bench.md. A file that fails is a
row with the program's own reason. Exit code 0 where every row is ok (or nothing of the asked section went wrong), else 1.

--real: instead every atlas of uv/ as it was found and every mesh of no_uv/ after Blender's Smart UV Project, at 0.80: how each ends;
exit code 1 where one crashes, hangs or is not valid.

--seams none needed rectangles: instead every file without seams, with rectangles, and with needed ones at two limits of distortion
(needed.json); exit code 1 where a limit is not kept or a result is not valid.

--equal-boundary: instead E_d of needed seams within +10, 20 and 40 % of boundary, of as many random necks, and of rectangles and
needed seams at the boundary that these add; exit code 1 where a result is missing or not valid.

--blender: instead the files of uv/atlas-clean inside Blender at 0.80 of a square, beside Blender's own Pack Islands (exact shapes,
any rotation) at the same margin; blender.json, blender.md.

--profile: instead where the processor's time of every file and goal goes: order, factor, solve, assembly, contacts, line search, packing,
layout, certificate, files, and how the Newton steps did; profile.json.

--peers: instead ten files at 0.80 beside what Blender's Pack Islands and xatlas pack: the table of README.md; peers.md.

--against COMMIT: that commit is built beside this tree, both programs run one after the other on every file, and what differs is
the table (against.json, against.md); exit code 1 where a file is no longer valid and at its bound, or has more E_d.

Meshes: --meshes OBJ files or folders of them; else the folder named by ATLAS_REFINE_MESHES, else what ../shared/data/unpack.sh unpacks.
"""

import argparse
import concurrent.futures
import fnmatch
import json
import shlex
import sys
import tempfile
from dataclasses import replace
from pathlib import Path

import against
import equal_boundary
import in_blender
import needed
import peers
import profiles
import real
import studies
import table
import trees
from bad_input import bad_input_lines
from check_atlas import aspect_of
from measure_file import Goal, Row, count_triangles, measure_file, outputs_differ
from meshes import FOLDERS, REAL_FOLDERS, REQUIRED_FOLDERS, NoMeshesError, folder_meshes, mesh_root, own_meshes
from subdivide import subdivided

ROOT = Path(__file__).resolve().parents[2]
GOALS = [Goal(0.80), Goal(0.90), Goal(0.80, "square"), Goal(0.85), Goal(0.95)]
GOALS_OF_CUTS = {"": [Goal(0.80)], "disk_deep": [Goal(0.85), Goal(0.90), Goal(0.80, "square")]}  # for every folder; for one
QUICK_TRIANGLES = 6000


def goal(text):
    bound, _, aspect = text.partition(":")
    aspect_of(aspect or "free")
    return Goal(float(bound), aspect or "free")


def goals_of(arguments, folder):
    """What is asked of the files of a folder; results with and without cuts of one bound beside each other."""
    cuts = GOALS_OF_CUTS[""] + GOALS_OF_CUTS.get(folder, [])
    asked = {"none": arguments.bounds or GOALS, "rectangles": arguments.bounds or cuts}
    goals = [replace(goal, seams=seams) for seams in arguments.seams for goal in asked[seams]]
    order = [(goal.bound, goal.aspect) for goal in [*(arguments.bounds or GOALS), *cuts]]
    return sorted(goals, key=lambda goal: (order.index((goal.bound, goal.aspect)), goal.cuts))


def selected_meshes(arguments):
    """{folder: its files}, small files first."""
    if arguments.meshes:
        found = own_meshes(arguments.meshes)
    else:
        usual = REAL_FOLDERS if arguments.real else ["atlas-clean"] if arguments.blender else FOLDERS
        folders = FOLDERS if arguments.study else arguments.folders or usual
        folders = peers.FILES if arguments.peers else folders
        found = folder_meshes(mesh_root(ROOT.parent / "shared"), folders)
        if arguments.peers:
            found = {folder: [path for path in paths if path.stem in peers.FILES[folder]] for folder, paths in found.items()}
    for folder, paths in found.items():
        kept = [path for path in paths if fnmatch.fnmatch(path.stem, arguments.files)]
        kept = [path for path in kept if not arguments.quick or count_triangles(path) <= QUICK_TRIANGLES]
        if arguments.subdivide:
            kept = [subdivided(path, arguments.subdivide, arguments.cache / "subdivided" / folder) for path in kept]
        found[folder] = sorted(kept, key=lambda path: (path.stat().st_size, path.name))
    if not any(found.values()):
        raise NoMeshesError("none of those that are there is asked for")
    return found


def each_mesh(arguments, folders=None):
    return [(folder, path) for folder in folders or arguments.found for path in arguments.found[folder]]


def guarded(work, rows_of_failure):
    try:
        return work()
    except Exception as error:  # one file must not end the table
        return rows_of_failure(f"bench: {type(error).__name__}: {error}")


def failed_rows(folder, path, goals, reason):
    return [Row(folder, path.stem, goal.name, goal.seams, count_triangles(path), reason=reason) for goal in goals]


def measure_guarded(build, folder, path, goals):
    return guarded(lambda: measure_file(build, folder, path, goals), lambda why: failed_rows(folder, path, goals, why))


def compare_guarded(programs, folder, path, goals):
    def failed(reason):
        return [against.Pair(row, row) for row in failed_rows(folder, path, goals, reason)]

    return guarded(lambda: against.compare_file(programs, folder, path, goals), failed)


def run_all(arguments, work, subject, line, file):
    """`work` for every file; each result is printed as soon as it is known, and all so far are in the JSON `file`."""
    results = []
    with concurrent.futures.ProcessPoolExecutor(arguments.jobs) as pool:
        tasks = [pool.submit(work, subject, f, path, goals_of(arguments, f)) for f, path in each_mesh(arguments)]
        for task in tasks:
            for result in task.result():
                results.append(result)
                print(line(result), flush=True)
            file.write_text(json.dumps([result.as_json() for result in results], indent=1))
    return results


def run_table(arguments, out):
    print(table.header(), flush=True)
    rows = run_all(arguments, measure_guarded, arguments.build, table.line, out / "bench.json")
    order = [goal.name for folder in arguments.found for goal in goals_of(arguments, folder)]
    rows.sort(key=lambda row: order.index(row.goal))
    lines = table.summary(rows)
    (out / "bench.md").write_text(table.markdown(rows, lines))
    print("\n" + table.NOTES + "\n\n" + "\n".join(lines))
    return sum(not row.ok for row in rows)


def run_against(arguments, out):
    old = trees.build_commit(arguments.against, ROOT, arguments.cache)
    programs = against.Programs(
        *(build / trees.PROGRAM for build in (old, arguments.build)), arguments.old_options, arguments.new_options
    )
    print(against.header(), flush=True)
    pairs = run_all(arguments, compare_guarded, programs, against.line, out / "against.json")
    lines = against.summary(pairs)
    (out / "against.md").write_text(against.markdown(f"This tree against {arguments.against}", pairs, lines))
    print("\n" + against.NOTES + "\n\n" + "\n".join(lines))
    return sum(pair.lost or pair.worse for pair in pairs)


def run_determinism(arguments):
    """The required folders at the first bound: two runs with one seed, and two threads."""
    return sum(determinism_at(replace((arguments.bounds or GOALS)[0], seams=seams), arguments) for seams in arguments.seams)


def determinism_at(at, arguments):
    wrong, count, longest = 0, 0, (0.0, "")
    for folder, path in each_mesh(arguments, [f for f in arguments.found if arguments.meshes or f in REQUIRED_FOLDERS]):
        difference, seconds = guarded(lambda path=path: outputs_differ(arguments.build, path, at), lambda why: (why, [0.0]))
        count, wrong = count + 1, wrong + bool(difference)
        longest = max(longest, (seconds[-1], f"{folder}/{path.stem}"))
        print(f"{folder}/{path.stem:40} {difference or 'same bits'}", flush=True)
    print(
        f"determinism at {at.name}: same bits from two runs and from 1 and 2 threads on {count - wrong} of {count} files; "
        f"longest with 2 threads, files included: {longest[0]:.1f} s ({longest[1]})"
    )
    return wrong


def run_real(arguments):
    at = replace((arguments.bounds or GOALS)[0], seams=arguments.seams[0], options=arguments.real_options)
    file = arguments.out / "real.json"
    return real.run_real(
        arguments.build / trees.PROGRAM, each_mesh(arguments), at, arguments.jobs, arguments.cache / "unwrapped", file
    )


def run_blender(arguments):
    bound = (arguments.bounds or GOALS)[0].bound
    return in_blender.run_blender(each_mesh(arguments), bound, arguments.cache, arguments.build, arguments.out)


def run_needed(arguments):
    at = replace((arguments.bounds or GOALS)[0], options=arguments.new_options)
    return needed.run_needed(arguments.build, each_mesh(arguments), at, arguments.jobs, arguments.out)


def run_equal_boundary(arguments):
    bound = (arguments.bounds or GOALS)[0].bound
    return equal_boundary.run_equal_boundary(arguments.build, each_mesh(arguments), bound, arguments.new_options)


def run_profiles(arguments):
    asked = [(folder, path, goals_of(arguments, folder)) for folder, path in each_mesh(arguments)]
    return profiles.run_profiles(arguments.build, asked, arguments.jobs, arguments.out)


def run_peers(arguments):
    at = (arguments.bounds or GOALS)[0]
    return peers.run_peers(arguments.build, arguments.found, at, arguments.cache, arguments.out)


def run_bad_input(arguments):
    lines, wrong = bad_input_lines(arguments.build / "atlas-refine")
    print("\n".join(lines))
    print(f"bad input: {len(lines) - wrong} of {len(lines)} as asked")
    return wrong


def options(text):
    return tuple(shlex.split(text))


def parsed():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0], epilog=__doc__.split("\n\n")[-1])
    parser.add_argument("--meshes", nargs="+", metavar="PATH", help="own OBJ files, or folders that are searched for them")
    parser.add_argument("--folders", nargs="+", choices=[*FOLDERS, *REAL_FOLDERS], help="of the test meshes [all]")
    parser.add_argument("--real", action="store_true", help="instead: real files, whatever they hold, and how each ends")
    parser.add_argument(
        "--real-options", type=options, default=("--open-closed",), help="of the program for those [--open-closed]"
    )
    parser.add_argument("--bounds", nargs="+", type=goal, help="0.8, 0.8:square, 0.8:16:9, ... [what is asked of the folder]")
    parser.add_argument(
        "--seams",
        nargs="+",
        choices=["none", "needed", "rectangles"],
        default=["none", "rectangles"],
        help="roads to take, where `needed` is among them all three in one table [none rectangles]",
    )
    parser.add_argument("--files", default="*", help="pattern of file names, without .obj")
    parser.add_argument("--jobs", type=int, default=1, help="files at a time; timings are honest only with 1")
    parser.add_argument("--subdivide", type=int, default=0, metavar="N", help="every triangle first divided into 4, N times")
    parser.add_argument("--quick", action="store_true", help=f"only files of at most {QUICK_TRIANGLES} triangles")
    parser.add_argument("--against", metavar="COMMIT", help="instead: this tree compared with a commit [at 0.8, both roads]")
    parser.add_argument(
        "--old-options", type=options, default=(), help="further options of the commit's program, as --old-options=..."
    )
    parser.add_argument("--new-options", type=options, default=(), help="further options of this tree's program")
    parser.add_argument("--equal-boundary", action="store_true", help="instead: needed seams beside random necks and rectangles")
    parser.add_argument("--profile", action="store_true", help="instead: where the time goes [at 0.8, both roads]")
    parser.add_argument("--peers", action="store_true", help="instead: beside Blender's Pack Islands and xatlas")
    parser.add_argument("--blender", action="store_true", help="instead: inside Blender, beside its own Pack Islands")
    parser.add_argument("--determinism", action="store_true", help="instead: the same bits from 2 runs and from 1 and 2 threads")
    parser.add_argument("--bad-input", action="store_true", help="instead: exit codes and messages of bad input")
    parser.add_argument("--study", choices=studies.NAMES, help="instead: one of the paper's studies, its figures beside ours")
    parser.add_argument("--build", type=Path, help="a build folder to take as it is, instead of building this tree")
    parser.add_argument("--out", type=Path, default=ROOT / "out" / "bench")
    parser.add_argument(
        "--cache", type=Path, default=Path(tempfile.gettempdir()) / "atlas-refine", help="where commits are built"
    )
    arguments = parser.parse_args()
    if arguments.meshes and (arguments.folders or arguments.study):
        parser.error("--meshes: not with --folders or --study, which are about the test meshes")
    if "needed" in arguments.seams and (arguments.against or arguments.profile or arguments.determinism):
        parser.error("--seams needed: only in a table of its own, or with --real")
    if arguments.peers and arguments.folders:
        parser.error("--peers: not with --folders; it has ten files of its own, or those of --meshes")
    if (arguments.against or arguments.profile) and not arguments.bounds:
        arguments.bounds = [Goal(0.80)]
    return arguments


def run_asked(arguments):
    """The section that was asked for; how many of its lines went wrong."""
    if arguments.bad_input:
        return run_bad_input(arguments)
    if arguments.determinism:
        return run_determinism(arguments)
    arguments.out.mkdir(parents=True, exist_ok=True)
    if arguments.real:
        return run_real(arguments)
    if arguments.equal_boundary:
        return run_equal_boundary(arguments)
    if arguments.profile:
        return run_profiles(arguments)
    if arguments.peers:
        return run_peers(arguments)
    if arguments.blender:
        return run_blender(arguments)
    if arguments.study:
        return studies.run_study(arguments.study, arguments, arguments.found.get)
    if "needed" in arguments.seams:
        return run_needed(arguments)
    return (run_against if arguments.against else run_table)(arguments, arguments.out)


def main():
    arguments = parsed()
    try:
        arguments.found = {} if arguments.bad_input else selected_meshes(arguments)
        random = [equal_boundary.RANDOM] * arguments.equal_boundary
        targets = [trees.PYTHON] * arguments.blender + random
        arguments.build = arguments.build.resolve() if arguments.build else trees.build_own(ROOT, *targets)
        trees.require_built(arguments.build, trees.PROGRAM, *([] if arguments.real else [trees.HELPER]), *random)
        return 1 if run_asked(arguments) else 0
    except (NoMeshesError, trees.TreeError) as why:
        sys.exit(f"bench: {why}")


if __name__ == "__main__":
    sys.exit(main())
