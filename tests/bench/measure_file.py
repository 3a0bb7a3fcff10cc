"""One file at one or several bounds: the program's run, the independent check, the charts' own optimum, as table rows."""

import json
import math
import os
import resource
import signal
import subprocess
import sys
import tempfile
import time
from dataclasses import asdict, dataclass, field
from pathlib import Path

import check_atlas

PROGRAM_LIMIT_S = 180  # three times what is allowed
HELPER_LIMIT_S = 900
E_D_TOLERANCE = 0.01  # triangles that are slivers in space are counted or not


@dataclass(frozen=True)
class Goal:
    """A bound, the shape of the texture it is measured in, where seams may come from, and further options of the program."""

    bound: float
    aspect: str = "free"  # or "square", "W:H"
    seams: str = "none"
    options: tuple = ()

    @property
    def name(self):
        return f"{self.bound:.2f} {self.aspect}" + (" rect" if self.cuts else "")

    @property
    def cuts(self):
        return self.seams != "none"

    def command_line(self):
        return ["--pe-bound", str(self.bound), "--aspect", self.aspect, "--seams", self.seams, *self.options]


@dataclass
class Row:
    """Figures of one file at one bound; `reason` says why there are none, or what the check found."""

    folder: str
    file: str
    goal: str
    seams: str = "none"
    triangles: int = 0  # of the input
    vertices: int = 0
    charts_in: int = 0
    charts: int = 0  # CN
    smallest: float = math.nan  # SA
    small_charts: int = 0  # N3
    reason: str = ""
    how: str = "failed"
    valid: bool = False
    met: bool = False
    added_seams: int | None = None  # edges; with cuts not counted
    bl_in: float = math.nan
    bl: float = math.nan
    fallbacks: list = field(default_factory=list)  # safety nets: what was tried first and what was done instead
    re_embedded: int = 0  # charts that overlapped themselves
    pe_in: float = math.nan
    pe: float = math.nan
    e_d_in: float = math.nan
    e_d: float = math.nan
    e_d_checked: float = math.nan  # by the checker: of polygons the triangulation that has least
    e_2: float = math.nan
    optimum: float = math.nan  # E_d of the charts under the engine without a bound
    stretch_99: float = math.nan
    stretch_max: float = math.nan
    gap: float = math.nan  # guaranteed between charts, fraction of the box diagonal
    gap_within_in: float = math.nan  # measured between borders of one chart, in the input
    gap_within: float = math.nan  # and in the result
    price: float = math.nan
    iterations: int = 0
    seconds: float = math.nan  # inside refine()
    cpu_seconds: float = math.nan  # the whole process, files read and written as well
    newton_seconds: float = math.nan  # one Newton iteration with stock Eigen
    peak_bytes: float = math.nan
    stages: dict = field(default_factory=dict)  # seconds of each

    @property
    def cuts(self):
        return self.seams != "none"

    @property
    def ok(self):
        return self.valid and self.met and (self.cuts or self.added_seams == 0)

    @property
    def nets(self):
        return len(self.fallbacks)

    @property
    def growth(self):
        """(E_out - E_in) / E_in."""
        return self.e_d / self.e_d_in - 1

    @property
    def added_length(self):
        """(BL_out - BL_in) / BL_in; not a number where there is no seam to begin with."""
        return self.bl / self.bl_in - 1 if self.bl_in > 0 else math.nan

    @property
    def extra(self):
        return self.e_d - self.optimum

    @property
    def nearer_within(self):
        """Borders of one chart ended nearer than the gap, and not because they were nearer in a usable input."""
        return self.gap_within < 0.999 * self.gap and (self.re_embedded > 0 or self.gap_within < 0.999 * self.gap_within_in)

    @property
    def time(self):
        """Time of refine() as an idle machine would have it: other programs lengthen `seconds` only."""
        return min(self.seconds, self.cpu_seconds)

    @property
    def newton_multiple(self):
        return self.time / self.newton_seconds

    def as_json(self):
        figures = ("ok", "nets", "growth", "added_length", "extra", "newton_multiple")
        numbers = asdict(self) | {name: getattr(self, name) for name in figures}
        return {k: None if isinstance(v, float) and not math.isfinite(v) else v for k, v in numbers.items()}


@dataclass(frozen=True)
class Run:
    """How one call of the program ended."""

    exit_code: int
    message: str
    report: dict = field(default_factory=dict)
    cpu_seconds: float = math.nan
    peak_bytes: float = math.nan

    @property
    def done(self):
        return self.exit_code == 0


def run_limited(command, seconds, cpu_seconds=resource.RLIM_INFINITY):
    """(exit code, stderr), None where there is no end in time; whatever it started ends with it."""

    def limit_processor_time():
        resource.setrlimit(resource.RLIMIT_CPU, (cpu_seconds, cpu_seconds))

    process = subprocess.Popen(
        command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, start_new_session=True, preexec_fn=limit_processor_time
    )
    try:
        message = process.communicate(timeout=seconds)[1].decode(errors="replace").strip()
    except BaseException as why:
        os.killpg(process.pid, signal.SIGKILL)
        process.communicate()
        if isinstance(why, subprocess.TimeoutExpired):
            return None
        raise
    return process.returncode, message


def refine(program, meshes, output, goal, threads=1, limit_s=PROGRAM_LIMIT_S, cpu_limit_s=resource.RLIM_INFINITY):
    """Runs the program on one file or on a collection; its report lies beside `output`."""
    meshes = [meshes] if isinstance(meshes, str | Path) else meshes
    report, figures = output.with_suffix(".json"), output.with_suffix(".figures")
    launcher = [sys.executable, "-S", "-E", Path(__file__).with_name("run_measured.py"), figures]
    command = [program, *meshes, "-o", output, *goal.command_line(), "--threads", str(threads), "--report", report]
    ended = run_limited([*launcher, *command], limit_s, cpu_limit_s)
    if ended is None:
        return Run(-1, f"no end after {limit_s} s")
    code, message = ended
    for mesh in meshes:
        message = message.replace(f"{mesh}: ", "")
    message = message.removeprefix("atlas-refine: ")
    used = json.loads(figures.read_text())
    if code == 0:
        return Run(0, message, json.loads(report.read_text()), **used)
    return Run(code, f"exit {code}: {message or 'no message'}", **used)


def number(value):
    return math.nan if value is None else value


def fill_from_report(row, report):
    before, after = report["before"], report["after"]
    row.vertices = sum(file["vertices"] for file in report["files"])
    row.how, row.charts_in, row.charts = report["intervention"], before["chart_count"], after["chart_count"]
    row.smallest, row.small_charts = number(after["smallest_chart"]), after["small_charts"]
    row.bl_in, row.bl = number(before["boundary_length"]), number(after["boundary_length"])
    row.fallbacks = report.get("fallbacks", [])
    row.re_embedded = sum(chart["re_embedded"] for chart in report["charts"])
    row.pe_in, row.pe = number(before["pe_fixed_aspect"]), number(after["pe_fixed_aspect"])
    row.e_d_in, row.e_d = number(before["distortion"]), number(after["distortion"])
    row.stretch_99, row.stretch_max = number(after["stretch_99"]), number(after["stretch_max"])
    row.gap = report["gap"]["value"]
    row.gap_within_in, row.gap_within = number(before["gap_within"]), number(after["gap_within"])
    row.price, row.iterations = number(report["price"]), report["iterations"]
    row.e_2 = number(after["distortion_to_input"])
    row.seconds = report["seconds"]["refine"]
    row.stages = {stage["stage"]: stage["seconds"] for stage in report["timings"]}


def gap_to_check(report):
    """What the program says of the gap, as arguments of the checker: of what is left as it is, the box is the charts' own."""
    unit = "diagonal" if report["gap"]["unit"] == "box_diagonal" else "long_side"
    box = "charts" if report["intervention"] == "unchanged" else "aspect"
    return {"gap": report["gap"]["value"], "gap_unit": unit, "gap_box": box}


def check_report(row, found):
    """What the program says of its result must be what the file holds; its E_d may be that of any way to divide polygons."""
    said = {"charts": (row.charts, found.get("charts"), 0), "pe": (row.pe, found.get("pe_fixed_aspect"), 1e-9)}
    said |= {"bl": (row.bl, found.get("bl"), 1e-9)}
    for name, (told, seen, tolerance) in said.items():
        if seen is not None and not abs(told - seen) <= tolerance * abs(seen):
            found["problems"].append(f"report: {name} is {told}, the file has {seen}")
    if row.how != "unchanged" and not found.get("fills_texture", True):
        found["problems"].append("UVs: do not fill the unit square")
    if "e_d" in found and row.e_d < found["e_d"] * (1 - E_D_TOLERANCE):
        found["problems"].append(f"report: E_d is {row.e_d:.4f}, the file has {found['e_d']:.4f} at least")


def fill_from_check(row, mesh, output, goal, report):
    aspect = check_atlas.aspect_of(goal.aspect)
    found = check_atlas.check(mesh, output, goal.bound, aspect, cuts=goal.cuts, charts=report["charts"], **gap_to_check(report))
    check_report(row, found)
    problems = [problem for problem in found["problems"] if not problem.startswith("PE:")]
    row.added_seams, row.e_d_checked = found.get("added_seams"), found.get("e_d", math.nan)
    row.valid, row.met = not problems, found["ok"] or "PE" not in " ".join(found["problems"])
    row.reason = "; ".join(found["problems"])


def count_triangles(mesh):
    lines = (line.split(b"#")[0].split() for line in Path(mesh).read_bytes().splitlines() if line.startswith(b"f"))
    return sum(len(tokens) - 3 for tokens in lines)


def helper_arguments(row, output, goal, report):
    width = repr(check_atlas.aspect_of(goal.aspect) or 1.0)
    return [output, width, *(["newton", "only"] if row.cuts else [repr(report["gap"]["value"]), report["gap"]["unit"]])]


def fill_from_helper(helper, mesh, results):
    """The charts' own optimum, the lesser of that found from the input and from the result, and the stock Newton iteration.

    `results`: row, file, goal and report of each."""
    command = [helper, mesh, *(word for result in results for word in helper_arguments(*result))]
    try:
        run = subprocess.run(command, capture_output=True, timeout=HELPER_LIMIT_S, check=True)
        answer = json.loads(run.stdout)
    except (subprocess.SubprocessError, ValueError) as error:
        answer = {"input": {}, "results": [{"error": f"optimum: {error}"} for _ in results]}
    for (row, *_), result in zip(results, answer["results"], strict=True):
        optima = [part["optimum"] for part in (answer["input"], result) if part.get("optimum") is not None]
        row.optimum = math.nan if row.cuts else min(optima, default=math.nan)
        row.newton_seconds = number(result.get("newton_seconds"))
        if "error" in result:
            row.reason = "; ".join(filter(None, [row.reason, result["error"]]))


def measure_run(program, folder, mesh, output, goal):
    """The program's run at one goal, checked: a row, and the report where there is one."""
    row = Row(folder, mesh.stem, goal.name, goal.seams, count_triangles(mesh))
    run = refine(program, mesh, output, goal)
    row.cpu_seconds, row.peak_bytes = run.cpu_seconds, run.peak_bytes
    if not run.done:
        row.reason = run.message
        return row, None
    fill_from_report(row, run.report)
    fill_from_check(row, mesh, output, goal, run.report)
    return row, run.report


def measure_file(build, folder, mesh, goals):
    """One row per goal."""
    with tempfile.TemporaryDirectory(prefix="atlas-refine-bench-") as scratch:
        outputs = [Path(scratch) / f"{k}.obj" for k in range(len(goals))]
        runs = [(*measure_run(build / "atlas-refine", folder, mesh, o, g), o, g) for o, g in zip(outputs, goals, strict=True)]
        rows = [row for row, *_ in runs]
        results = [(row, output, goal, report) for row, report, output, goal in runs if report]
        if results:
            fill_from_helper(build / "atlas_refine_bench", mesh, results)
        return rows


def outputs_differ(build, mesh, goal):
    """Empty where two runs with one thread and one with two give the same bytes; else what differs. And their wall times."""
    with tempfile.TemporaryDirectory(prefix="atlas-refine-bench-") as scratch:
        texts, seconds = [], []
        for k, threads in enumerate((1, 1, 2)):
            output = Path(scratch) / f"{k}.obj"
            started = time.monotonic()
            run = refine(build / "atlas-refine", mesh, output, goal, threads)
            seconds.append(time.monotonic() - started)
            texts.append(output.read_bytes() if run.done else run.message)
        if not isinstance(texts[0], bytes):
            return texts[0], seconds
        if texts[0] != texts[1]:
            return "two runs differ", seconds
        return ("" if texts[0] == texts[2] else "1 and 2 threads differ"), seconds
