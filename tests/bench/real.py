"""Real files, whatever they hold: how each ends, and what the checker says. One line for every file, no silent skips."""

import concurrent.futures
import json
import math
import re
import signal
import subprocess
import tempfile
from collections import Counter
from dataclasses import asdict, dataclass, replace
from pathlib import Path

import check_atlas
import measure_file

LIMIT_S = 60  # processor time of one thread: what an idle machine needs
PATIENCE = 10  # times as long by the clock
KILLED = (128 + signal.SIGXCPU, 128 + signal.SIGKILL)
BLENDER_LIMIT_S = 300
FAILURES = ("crash", "hang", "invalid", "no UVs")
REFUSALS = {3: "bad input", 4: "bound not reached"}


@dataclass
class Ending:
    """How one file ended: refined as it says in `how`, refused, or a failure."""

    folder: str
    file: str
    how: str
    why: str = ""
    pe: float = math.nan
    e_d: float = math.nan
    e_2: float = math.nan
    seconds: float = math.nan
    charts: int = 0
    left: int = 0  # charts

    @property
    def failed(self):
        return self.how in FAILURES

    def line(self):
        figures = [
            f"{x:{form}}" if math.isfinite(x) else "-" for x, form in ((self.pe, ".4f"), (self.e_d, ".4f"), (self.e_2, ".4f"))
        ]
        name = f"{self.folder}/{self.file}"[:52]
        parts = f"{self.charts} charts" + (f", {self.left} left" if self.left else "") if self.charts else ""
        seconds = f"{self.seconds:.1f}" if math.isfinite(self.seconds) else "-"
        return f"{name:52} {self.how:9} {figures[0]:>7} {figures[1]:>9} {figures[2]:>9} {seconds:>6} s  {'; '.join(filter(None, (parts, self.why)))}"


def header():
    return f"{'file':52} {'how':9} {'PE':>7} {'E_d':>9} {'E_2':>9} {'time':>6}    charts; what was found, or why not"


def ended(run):
    """The ending of a run without a result."""
    if run.exit_code == -1 or run.exit_code in KILLED:
        return {"how": "hang", "why": f"no end after {LIMIT_S} s"}
    if run.exit_code in REFUSALS:
        return {"how": "refused", "why": run.message}
    return {"how": "crash", "why": run.message}


def with_result(ending, mesh, output, goal, report):
    after, charts = report["after"], report["charts"]
    left = sum(chart.get("fate") == "left" for chart in charts)
    figures = {"pe": after["pe_fixed_aspect"], "e_d": after["distortion"], "e_2": after["distortion_to_input"]}
    figures = {name: measure_file.number(value) for name, value in figures.items()}
    aspect = check_atlas.aspect_of(goal.aspect)
    gap = measure_file.gap_to_check(report)
    cuts = report["options"]["seams"] != "none"
    opened = any("opened along edges" in repair["what"] for repair in report["repairs"])
    found = check_atlas.check(mesh, output, goal.bound, aspect, cuts=cuts, charts=charts, added_seams=opened and not cuts, **gap)
    how = report["intervention"] if found["ok"] else "invalid"
    why = "valid" if found["ok"] else "; ".join(found["problems"])
    seconds = report["seconds"]["refine"]
    return replace(ending, how=how, why=why, charts=len(charts), left=left, seconds=seconds, **figures)


def run_file(program, folder, mesh, name, goal):
    ending = Ending(folder, name, "crash")
    with tempfile.TemporaryDirectory(prefix="atlas-refine-real-") as scratch:
        output = Path(scratch) / "out.obj"
        try:
            run = measure_file.refine(program, mesh, output, goal, limit_s=PATIENCE * LIMIT_S, cpu_limit_s=LIMIT_S)
        except OSError as error:
            return replace(ending, why=f"not started: {error}")
        if not run.done:
            return replace(ending, seconds=run.cpu_seconds, **ended(run))
        try:
            return with_result(ending, mesh, output, goal, run.report)
        except Exception as error:  # what the checker cannot read is not valid
            return replace(ending, how="invalid", why=f"checker: {type(error).__name__}: {error}")


def unwrapped(mesh, cache):
    """The file with UVs by Blender's Smart UV Project; the reason where there are none."""
    target = cache / f"{mesh.parent.name}-{mesh.stem}-{mesh.stat().st_size}.obj"
    if target.exists():
        return target, ""
    cache.mkdir(parents=True, exist_ok=True)
    script = Path(__file__).with_name("smart_uv.py")
    partial = target.with_suffix(".partial.obj")
    command = ["blender", "--background", "--factory-startup", "--python-exit-code", "1", "--python", script, "--", mesh, partial]
    try:
        run = subprocess.run(command, capture_output=True, timeout=BLENDER_LIMIT_S, check=False, text=True, errors="replace")
    except subprocess.TimeoutExpired:
        return None, f"Blender did not end in {BLENDER_LIMIT_S} s"
    if run.returncode or not partial.exists():
        return None, "Blender: " + ((run.stderr.strip() or run.stdout.strip()).splitlines() or ["no message"])[-1]
    partial.rename(target)
    return target, ""


def end_of(program, folder, mesh, goal, cache):
    source, why = unwrapped(mesh, cache) if folder.startswith("no_uv/") else (mesh, "")
    if source is None:
        return Ending(folder, mesh.stem, "no UVs", why)
    return run_file(program, folder, source, mesh.stem, goal)


def kind_of(reason):
    """Without the numbers and names of what it is about."""
    return re.sub(r"[0-9.]+", "N", re.sub(r"^exit \d+: (line \d+: )?| \(.*", "", reason))[:100]


def summary(endings):
    lines = []
    for folder in [*dict.fromkeys(ending.folder for ending in endings), ""]:
        own = [ending for ending in endings if folder in ("", ending.folder)]
        counts = Counter(ending.how for ending in own)
        refused, failures = counts["refused"], sum(counts[how] for how in FAILURES)
        each = ", ".join(f"{count} {how}" for how, count in sorted(counts.items()))
        share = 100 * (len(own) - refused - failures) / len(own)
        lines.append(f"{folder or 'all':28} {len(own):4} files: {share:5.1f} % not refused, {failures} failures ({each})")
    reasons = Counter(kind_of(ending.why) for ending in endings if ending.how == "refused")
    return lines + [f"refused {count:3} x {reason}" for reason, count in reasons.most_common()]


def run_real(program, files, goal, jobs, cache, out):
    """Prints every file's ending and the summary; how many failed. `files`: (folder, path)."""
    print(header(), flush=True)
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        endings = []
        for ending in pool.map(lambda file: end_of(program, *file, goal, cache), files):
            endings.append(ending)
            print(ending.line(), flush=True)
            out.write_text(json.dumps([asdict(e) for e in endings], indent=1))
    print("\n" + "\n".join(summary(endings)))
    return sum(ending.failed for ending in endings)
