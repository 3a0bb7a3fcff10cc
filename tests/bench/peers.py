"""The section --peers: squeeze and rectangles beside what Blender's Pack Islands and xatlas pack of the same charts.

Packers leave the charts' shapes as they are; the checker measures every result in the same way.
"""

import itertools
import json
import math
import subprocess
import sys
import tempfile
from dataclasses import dataclass, replace
from pathlib import Path

import check_atlas
import numpy as np
import trees
from measure_file import refine
from obj_text import read_obj

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools"))

import blenders

XATLAS = "xatlas==0.0.11"
GAP = 0.0025  # of the diagonal: what an automatic gap starts with
LIMIT_SECONDS = 300
# Of one chart and many, round and winding, with holes and without; valid as they are, or the packers' results could not be.
FILES = {
    "disk": ["tooth_20k", "horse_20k", "statue2_20k", "igea_100k"],
    "atlas-clean": [
        "cinolib__blub_triangulated", "libero__stable_scanned_objects__chefmate_8_frypan", "makehuman-assets__hair__bob02",
        "gazebo-models__r2_description__r2_upperbody__Head--material_4",
    ],
    "atlas-nondisk-charts": ["gazebo-models__pr2__upper_arm_v0__upper_arm", "gazebo-models__pr2__base_v0__wheel_h"],
}  # fmt: skip
WAYS = {"pack_islands": "Pack Islands", "xatlas": "xatlas", "none": "squeeze", "rectangles": "rectangles"}
NOTE = (
    "PE: of the charts' own box; E_d: 1 = isometric, packers keep the input's; s: processor seconds, of ours the whole program on one\n"
    f"thread, files included, of the packers all threads in the packer alone; a packer has {LIMIT_SECONDS} s. Gap: {GAP} of the diagonal"
)


@dataclass(frozen=True)
class Result:
    pe: float = math.nan
    e_d: float = math.nan
    seconds: float = math.nan
    reason: str = ""  # why there is none, or what the checker found


def environment(cache, name):
    """The Python of an environment in the cache that holds one package of PyPI."""
    folder = Path(cache) / name
    if not (folder / "complete").exists():
        print(f"installing {name}", flush=True)
        subprocess.run([sys.executable, "-m", "venv", "--clear", folder], check=True)
        subprocess.run([folder / "bin" / "pip", "install", "-q", name, "numpy"], check=True)
        (folder / "complete").touch()
    return str(folder / "bin" / "python")


def pythons(cache):
    return {"pack_islands": blenders.official(every=False)[0].installed(cache).python, "xatlas": environment(cache, XATLAS)}


def obj_of(mesh, corner_uv):
    """An OBJ with a vt record for each value."""
    values, records = np.unique(corner_uv, axis=0, return_inverse=True)
    corners = [f"{v + 1}/{t + 1}" for v, t in zip(mesh.corner_vertex.tolist(), records.reshape(-1).tolist(), strict=True)]
    lines = [f"v {x!r} {y!r} {z!r}" for x, y, z in mesh.positions.tolist()] + [f"vt {u!r} {v!r}" for u, v in values.tolist()]
    offsets = mesh.offsets.tolist()
    lines += ["f " + " ".join(corners[a:b]) for a, b in itertools.pairwise(offsets)]
    return "\n".join(lines) + "\n"


def checked(source, result, seconds, **more):
    found = check_atlas.check(source, result, **more)
    return Result(found.get("pe", math.nan), found.get("e_d", math.nan), seconds, "; ".join(found["problems"]))


def packed(python, peer, mesh, source, limit=LIMIT_SECONDS):
    """What a peer makes of the file `source`, whose arrays are `mesh`."""
    arrays = source.with_suffix(".npz")
    np.savez(arrays, positions=mesh.positions, offsets=mesh.offsets, corner_vertex=mesh.corner_vertex, corner_uv=mesh.corner_uv)
    command = [python, Path(__file__).with_name("pack_with_peer.py"), peer, arrays, str(GAP)]
    try:
        done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=limit)
    except subprocess.TimeoutExpired:
        return Result(reason=f"nothing after {limit} s")
    told = [text for text in done.stdout.splitlines() if text.startswith('{"peer"')]
    if not told:
        return Result(reason=(done.stderr.strip().splitlines() or ["nothing was printed"])[-1])
    result = source.with_name(f"{peer}.obj")
    result.write_text(obj_of(mesh, np.load(arrays.with_suffix(".npy"))))
    return checked(source, result, json.loads(told[-1])["seconds"])


def refined(program, goal, source):
    result = source.with_name(f"{goal.seams}.obj")
    run = refine(program, source, result, goal)
    if not run.done:
        return Result(reason=run.message)
    return checked(source, result, run.cpu_seconds, pe_bound=goal.bound, cuts=goal.cuts, charts=run.report["charts"])


def compare_file(program, python, folder, path, at):
    """{way: its Result} of one file, with what it is."""
    mesh = read_obj(path)
    with tempfile.TemporaryDirectory(prefix="atlas-refine-bench-") as scratch:
        source = Path(scratch) / "in.obj"
        source.write_text(obj_of(mesh, mesh.corner_uv))
        results = {peer: packed(python[peer], peer, mesh, source) for peer in python}
        results |= {seams: refined(program, replace(at, seams=seams), source) for seams in ("none", "rectangles")}
        given = checked(source, source, 0.0)
    triangles = len(mesh.corner_vertex) - 2 * (len(mesh.offsets) - 1)
    return {"file": f"{folder}/{path.stem}", "triangles": triangles, "given": given, **results}


def cell(result):
    if math.isnan(result.pe):
        return "-", "-", "-"
    mark = "" if not result.reason else " (not valid)"
    return f"{result.pe:.3f}{mark}", f"{result.e_d:.4f}", f"{result.seconds:.2f}"


def markdown(rows):
    """The table of README.md."""
    names = [f"{name}: {figure}" for name in WAYS.values() for figure in ("PE", "E_d", "s")]
    lines = ["| " + " | ".join(["file", "triangles", "PE in", *names]) + " |", "|---" * (3 + len(names)) + "|"]
    for row in rows:
        figures = [text for way in WAYS for text in cell(row[way])]
        lines.append("| " + " | ".join([row["file"], str(row["triangles"]), f"{row['given'].pe:.3f}", *figures]) + " |")
    return lines


def run_peers(build, found, at, cache, out):
    """`found`: {folder: files}. Prints a row for each file; how many results of ours are not valid and at the bound."""
    python, rows = pythons(cache), []
    print(NOTE + "\n\n" + "\n".join(markdown([])), flush=True)
    for folder, paths in found.items():
        for path in paths:
            rows.append(compare_file(build / trees.PROGRAM, python, folder, path, at))
            print(markdown(rows[-1:])[-1], flush=True)
            (out / "peers.md").write_text("\n".join([*markdown(rows), "", NOTE, ""]))
    for row in rows:
        for way, name in WAYS.items():
            if row[way].reason:
                print(f"{row['file']}: {name}: {row[way].reason}")
    return sum(bool(row[way].reason) for row in rows for way in ("none", "rectangles"))
