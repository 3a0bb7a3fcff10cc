"""E_d at equal added boundary: needed seams, as many necks chosen at random, and rectangles, which have one boundary each."""

import json
import math
import statistics
import subprocess
import tempfile
from dataclasses import dataclass, field, replace
from pathlib import Path

import trees
from measure_file import Goal, measure_run

BUDGETS = (0.1, 0.2, 0.4)  # of boundary that may be added
DRAWS = 3  # of random necks, at each budget
LEAST = ("--max-distortion", "1", "--best-effort")  # asks for the least distortion within the budget
LOW_DISTORTION = 1.2  # inputs above this E_d are left out
RANDOM = "atlas_refine_random_necks"


@dataclass
class Point:
    """What one budget comes to."""

    growth: float = math.nan
    e_d: float = math.nan
    cuts: int = 0
    random: list = field(default_factory=list)  # E_d of each draw
    reason: str = ""

    @property
    def by_chance(self):
        return statistics.fmean(self.random) if self.random else math.nan


@dataclass
class File:
    """One file: without cuts, within each budget, as rectangles, and within the boundary that these add."""

    name: str
    e_d_in: float = math.nan
    whole: float = math.nan
    points: dict = field(default_factory=dict)
    rectangles: Point = field(default_factory=Point)
    at_rectangles: Point = field(default_factory=Point)

    @property
    def reasons(self):
        return [point.reason for point in (*self.points.values(), self.rectangles, self.at_rectangles) if point.reason]


def point_of(row, report):
    if not row.valid:
        return Point(reason=row.reason or "not valid")
    return Point(report["boundary_growth"], row.e_d, (report["cuts"] or {}).get("cuts", 0))


def within(build, folder, mesh, output, bound, growth, options):
    """Needed seams that add no more than that."""
    goal = Goal(bound, seams="needed", options=(*LEAST, "--max-boundary-growth", repr(growth), *options))
    return point_of(*measure_run(build / trees.PROGRAM, folder, mesh, output, goal))


def drawn(build, mesh, bound, growth, cuts):
    """E_d of each draw of so many random necks; none where the needed seams are none."""
    command = [build / RANDOM, mesh, repr(bound), repr(growth), str(cuts), str(DRAWS)]
    answer = subprocess.run(list(map(str, command)), capture_output=True, text=True, check=True)
    return [draw["distortion"] for draw in json.loads(answer.stdout)]


def measure(build, folder, mesh, bound, options):
    file = File(f"{folder}/{mesh.stem}")
    with tempfile.TemporaryDirectory(prefix="atlas-refine-bench-") as scratch:
        output = Path(scratch) / "out.obj"
        squeeze = Goal(bound)
        row, _ = measure_run(build / trees.PROGRAM, folder, mesh, output, squeeze)
        file.e_d_in, file.whole = row.e_d_in, row.e_d
        file.rectangles = point_of(
            *measure_run(build / trees.PROGRAM, folder, mesh, output, replace(squeeze, seams="rectangles"))
        )
        for growth in BUDGETS:
            point = file.points[growth] = within(build, folder, mesh, output, bound, growth, options)
            if point.cuts:
                point.random = drawn(build, mesh, bound, growth, point.cuts)
        if file.rectangles.growth > 0:
            file.at_rectangles = within(build, folder, mesh, output, bound, file.rectangles.growth, options)
    return file


def header():
    budgets = "".join(f"{f'+{growth:.0%}: needed, random':>24}" for growth in BUDGETS)
    return f"{'file':36}{'E_d in':>8}{'whole':>8}{budgets}{'rectangles':>20}{'needed there':>20}"


def cell(point):
    return f"{point.e_d:.4f} {point.growth:+7.1%}" if math.isfinite(point.e_d) else (point.reason or "-")[:18]


def line(file):
    budgets = "".join(f"{f'{point.e_d:.4f} ({point.cuts}) {point.by_chance:.4f}':>24}" for point in file.points.values())
    return f"{file.name:36}{file.e_d_in:8.4f}{file.whole:8.4f}{budgets}{cell(file.rectangles):>20}{cell(file.at_rectangles):>20}"


def mean(values):
    return statistics.fmean(values) if values else math.nan


def compared(text, ours, theirs):
    """Means over files that have both, and on how many ours is the lower."""
    pairs = [pair for pair in zip(ours, theirs, strict=True) if all(map(math.isfinite, pair))]
    if not pairs:
        return f"{text}: no file has both"
    own, other = (mean([pair[k] for pair in pairs]) for k in (0, 1))
    lower = sum(a < b for a, b in pairs)
    return f"{text}, {len(pairs)} files: E_d {own:.4f} against {other:.4f}, lower on {lower}: {'yes' if own < other else 'NO'}"


def summary(files):
    """Verdicts where both add about as much; what rectangles reach with more is told beside."""
    low = [file for file in files if file.e_d_in < LOW_DISTORTION]
    lines = [
        f"{len(files)} files, {len(low)} with E_d in < {LOW_DISTORTION}; without cuts E_d {mean([f.whole for f in low]):.4f}"
    ]
    for growth in BUDGETS:
        points = [file.points[growth] for file in low]
        cut = [point for point in points if point.cuts]
        short = [file for file in low if file.rectangles.growth <= growth]
        own = mean([point.e_d for point in points if math.isfinite(point.e_d)])
        cuts = mean([point.cuts for point in points])
        lines += [
            f"at most +{growth:.0%}: needed seams E_d {own:.4f}, with {cuts:.1f} cuts in the mean",
            "  " + compared("beside random necks, as many", [p.e_d for p in cut], [p.by_chance for p in cut]),
            "  "
            + compared(
                "beside rectangles that add no more", [f.points[growth].e_d for f in short], [f.rectangles.e_d for f in short]
            ),
        ]
    added = mean([file.rectangles.growth for file in low if math.isfinite(file.rectangles.growth)])
    text = f"rectangles add {added:+.1%}; needed seams within that"
    lines.append(compared(text, [f.at_rectangles.e_d for f in low], [f.rectangles.e_d for f in low]))
    return lines


def run_equal_boundary(build, meshes, bound, options):
    """All files; how many results there are not."""
    print(header(), flush=True)
    files = []
    for folder, mesh in meshes:
        files.append(measure(build, folder, mesh, bound, options))
        print(line(files[-1]), flush=True)
    print("\n" + "\n".join(summary(files)))
    return sum(len(file.reasons) for file in files)
