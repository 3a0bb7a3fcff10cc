"""The section --blender: files beside Blender's own Pack Islands, in an official build of Blender."""

import json
import os
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools"))

import blenders

LIMIT_SECONDS = 1800  # for one way with one file, by the clock
MARGIN_PX, TEXTURE_SIZE = 4, 2048
WAYS = ("input", "pack islands", "atlas refine")


NOTE = (
    "gap px: smallest distance between charts, border: to the border of the texture; Pack Islands keeps its margin to the border\n"
    "and twice as much between charts. s: processor seconds in the operator; * the result is not valid"
)


def run_blender(files, bound, cache, build, out):
    """Prints a row for each file and the means; how many files have no valid result at the bound."""
    blender = blenders.official(every=False)[0].installed(cache)
    rows = []
    with tempfile.TemporaryDirectory(prefix="atlas-refine-profile-") as profile:
        environment = {**os.environ, "BLENDER_USER_RESOURCES": profile}
        install(blender, build, profile, environment)
        print(f"{blender.name}, bound {bound:g} of a square of {TEXTURE_SIZE} px, margin {MARGIN_PX} px to the border as well")
        print(NOTE)
        print(header(), flush=True)
        for folder, path in files:
            row = {"file": f"{folder}/{path.stem}", **measured(blender, path, bound, environment)}
            rows.append(row)
            print(line(row), flush=True)
            (out / "blender.json").write_text(json.dumps(rows, indent=1))
    (out / "blender.md").write_text(
        "```\n" + "\n".join([NOTE, header(), *map(line, rows), "", *summary(rows, bound)]) + "\n```\n"
    )
    print("\n" + "\n".join(summary(rows, bound)))
    return sum(not holds(row, bound) for row in rows)


def install(blender, build, profile, environment):
    subprocess.run([sys.executable, ROOT / "tools" / "package_addon.py", profile, build], check=True, stdout=subprocess.DEVNULL)
    (archive,) = Path(profile).glob("atlas_refine-*.zip")
    script = blender.script(ROOT / "blender_tests" / "install_addon.py")
    subprocess.run([*script, archive], env=environment, check=True, stdout=subprocess.DEVNULL)


def measured(blender, path, bound, environment):
    """A row's figures. Each way has a process of its own: what becomes of one says nothing of the other."""
    row, why_not = {}, []
    for way in WAYS[1:]:
        found = run_way(blender, path, way, bound, environment)
        if reason := found.pop("why not", None):
            why_not.append(f"{way}: {reason}")
        row.update(found)
    return {**row, "why not": "; ".join(why_not)} if why_not else row


def run_way(blender, path, way, bound, environment):
    script = Path(__file__).with_name("beside_pack_islands.py")
    command = [*blender.script(script)[:-1], path, way, str(bound), str(MARGIN_PX), str(TEXTURE_SIZE)]
    try:
        done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False, timeout=LIMIT_SECONDS)
    except subprocess.TimeoutExpired:
        return {"why not": f"nothing after {LIMIT_SECONDS} s"}
    found = [text for text in done.stdout.splitlines() if text.startswith('{"triangles"')]
    return json.loads(found[-1]) if found else {"why not": (done.stderr.strip().splitlines() or ["nothing was printed"])[-1]}


def holds(row, bound):
    ours = row.get("atlas refine")
    return ours is not None and ours["valid"] and ours["use"] >= bound


def cells(row, way):
    found = row.get(way)
    if found is None:
        return f"{'-':>6}  {'-':>8} {'-':>6} {'-':>6} {'-':>7}"
    gap = "-" if found["gap_px"] is None else f"{found['gap_px']:.1f}"
    seconds = f"{found['seconds']:.2f}" if way != "input" else "-"
    mark = " " if found["valid"] else "*"
    return f"{found['use']:6.3f}{mark} {found['e_d']:8.4f} {gap:>6} {found['border_px']:6.1f} {seconds:>7}"


def header():
    columns = f"{'use':>6}  {'E_d':>8} {'gap px':>6} {'border':>6} {'s':>7}"
    return f"{'file':40} {'tris':>6} {'CN':>4} " + " ".join(f"| {way:12} {columns}" for way in WAYS)


def line(row):
    charts = row.get("input", {}).get("charts", "-")
    text = f"{row['file'][:40]:40} {row.get('triangles', '-'):>6} {charts:>4} "
    return text + " ".join(f"| {'':12} {cells(row, way)}" for way in WAYS) + (f"  {row['why not']}" if "why not" in row else "")


def summary(rows, bound):
    both = [row for row in rows if all(way in row for way in WAYS)]
    if not both:
        return ["no file has results of both"]

    def mean(way, name):
        return statistics.fmean(row[way][name] for row in both)

    lines = [f"atlas refine valid and at the bound: {sum(holds(row, bound) for row in rows)} of {len(rows)}"]
    lines.append(f"pack islands valid: {sum(row.get('pack islands', {}).get('valid', False) for row in rows)} of {len(rows)}")
    lines.append(f"of the {len(both)} files with both results:")
    for way in WAYS:
        seconds = "" if way == "input" else f", {mean(way, 'seconds'):.2f} s"
        lines.append(
            f"{way:12} mean texture use {mean(way, 'use'):.3f}, E_d {mean(way, 'e_d'):.4f} "
            f"(median {statistics.median(row[way]['e_d'] for row in both):.4f}){seconds}"
        )
    more = sum(row["atlas refine"]["use"] > row["pack islands"]["use"] for row in both)
    less = sum(row["atlas refine"]["e_d"] <= row["pack islands"]["e_d"] for row in both)
    quicker = sum(row["atlas refine"]["seconds"] < row["pack islands"]["seconds"] for row in both)
    lines.append(f"atlas refine: more use on {more}, no more E_d on {less}, less time on {quicker} of {len(both)}")
    return lines
