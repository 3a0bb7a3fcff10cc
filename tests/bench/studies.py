"""The paper's studies on our meshes, its figures beside ours: ./dev bench --study NAME.

Files are chosen by rule: the first ones by name of the folder with seams like the paper's, or all. The paper's lines are from its
Table 1 and section 4; its models are not ours, so what compares is how figures change from line to line.
"""

import json
import math
import tempfile
from dataclasses import dataclass, replace
from pathlib import Path

from measure_file import Goal, Row, count_triangles, fill_from_check, fill_from_report, refine
from obj_text import one_after_the_other, read_obj
from signal_error import signal_error
from study_statistics import statistics_lines

FEW = 3  # files of a study that shows single files
COLLECTION = 10  # models, as in Fig. 14
SQUEEZE = Goal(0.80)
OPTIMUM = Goal(0.80, seams="rectangles")
RECTANGLES = replace(OPTIMUM, options=("--until-input",))  # the paper stops where the distortion is back at the input's


@dataclass
class Figures:
    """One line of a study; what is not known is None."""

    file: str
    setting: str
    triangles: int | None = None
    bl_in: float | None = None
    e_d_in: float | None = None
    sae_in: float | None = None
    pe: float | None = None  # per cent
    bl: float | None = None
    charts: int | None = None
    smallest: float | None = None  # per cent
    small_charts: int | None = None
    e_d: float | None = None
    e_2: float | None = None
    sae: float | None = None
    stages: tuple = ()  # t1, t2, t3
    seconds: float | None = None
    reason: str = ""


def paper(file, setting, triangles, before, after, times):
    """A line of Table 1: (BL, E_d, SAE), (PE, BL, CN, SA, N3, E_d, E_2, SAE), (t1, t2, t3, total)."""
    return Figures(f"paper: {file}", setting, triangles, *before, *after, times[:3], times[3])


CAMEL = (18816, (7.69, 1.027, 0.0131))
CENTAUR = (18868, (10.45, 1.037, 0.0135))
BOY = (34036, (5.58, 1.039, 0.0177))
PAPER = {
    "sigma": [
        paper("Camel, Fig. 12", "sigma 0.001", *CAMEL, (91.1, 16.26, 29, 0.07, 19, 1.017, 1.022, 0.0047), (3.82, 0.20, 8.58, 12.60)),
        paper("Camel, Fig. 12", "sigma 0.004", *CAMEL, (88.7, 13.61, 16, 0.81, 5, 1.021, 1.025, 0.0049), (6.26, 0.14, 14.32, 20.72)),
        paper("Camel, Fig. 12", "sigma 0.006", *CAMEL, (85.3, 12.89, 14, 0.72, 4, 1.023, 1.026, 0.0051), (3.98, 0.12, 11.60, 15.70)),
    ],
    "bounds": [
        paper("Boy, Fig. 13", "bound 0.80", *BOY, (80.0, 9.68, 14, 0.26, 5, 1.037, 1.015, 0.0099), (6.56, 0.13, 30.67, 37.36)),
        paper("Boy, Fig. 13", "bound 0.85", *BOY, (85.0, 9.68, 14, 0.26, 5, 1.041, 1.017, 0.0094), (6.56, 0.13, 22.02, 28.71)),
        paper("Boy, Fig. 13", "bound 0.90", *BOY, (90.0, 9.68, 14, 0.26, 5, 1.049, 1.024, 0.0090), (6.56, 0.13, 7.45, 14.14)),
    ],
    "gaps": [
        paper("Centaur, Fig. 11", "gap 0", *CENTAUR, (83.7, 18.81, 26, 0.25, 11, 1.027, 1.039, 0.0055), (3.37, 0.22, 5.83, 9.42)),
        paper("Centaur, Fig. 11", "gap", *CENTAUR, (80.1, 18.81, 26, 0.25, 11, 1.026, 1.036, 0.0057), (3.37, 0.22, 8.72, 12.31)),
    ],
    "collection": [
        paper(
            "10 models, Fig. 14", "rectangles", 106058, (14.42, 1.022, 0.0238),
            (80.0, 22.79, 64, 0.15, 57, 1.026, 1.019, 0.0119), (19.80, 0.60, 73.11, 93.51),
        ),
        Figures("Box Cutter: 10 models, Fig. 14", "cut and repack", 106058, pe=69.9),
    ],
    "sae": [
        paper("Armadillo", "rectangles", 18894, (6.34, 1.040, 0.0100), (85.0, 11.45, 13, 0.90, 3, 1.030, 1.031, 0.0052), (2.59, 0.16, 2.70, 5.45)),
        paper("Bunny", "rectangles", 69451, (16.30, 1.010, 0.0321), (85.8, 21.24, 26, 0.19, 12, 1.007, 1.013, 0.0118), (12.32, 0.25, 40.42, 52.99)),
        paper("Penguin", "rectangles", 14976, (7.53, 1.119, 0.0067), (92.6, 12.84, 25, 0.21, 22, 1.018, 1.106, 0.0050), (2.48, 0.16, 9.13, 11.77)),
    ],
}  # fmt: skip

FILE_WIDTH = 31
COLUMNS = (
    ("file", "file", str(FILE_WIDTH)),
    ("setting", "setting", "14"),
    ("tris", "triangles", ">7"),
    ("PE %", "pe", ">5.1f"),
    ("BL in", "bl_in", ">6.2f"),
    ("BL", "bl", ">6.2f"),
    ("CN", "charts", ">4"),
    ("SA %", "smallest", ">6.2f"),
    ("N3", "small_charts", ">3"),
    ("E_d in", "e_d_in", ">6.4f"),
    ("E_d", "e_d", ">6.4f"),
    ("E_2", "e_2", ">6.4f"),
    ("SAE in", "sae_in", ">6.4f"),
    ("SAE", "sae", ">6.4f"),
)


def header():
    return "  ".join(f"{name:{form.split('.')[0]}}" for name, _, form in COLUMNS) + "  t1/t2/t3                s  reason"


def line(figures):
    cells = []
    for _, name, form in COLUMNS:
        value = getattr(figures, name)
        value = value[:FILE_WIDTH] if name == "file" else value
        known = value is not None and value == value
        cells.append(format(value if known else "-", form if known else form.split(".")[0]))
    stages = "/".join(f"{t:.2f}" for t in figures.stages) or "-"
    seconds = "-" if figures.seconds is None else f"{figures.seconds:.2f}"
    return "  ".join([*cells, f"{stages:18}", f"{seconds:>6}", figures.reason]).rstrip()


def with_options(goal, *options):
    return replace(goal, options=goal.options + options)


class Study:
    def __init__(self, name, arguments, meshes):
        """`meshes` gives the paths of a folder's files, smallest first."""
        self.name, self.arguments, self.meshes = name, arguments, meshes
        self.program = arguments.build / "atlas-refine"
        self.all, self.sae_of_input = [], {}

    def first(self, folder, count=FEW):
        return sorted(self.meshes(folder), key=lambda path: path.name)[:count]

    def run(self, meshes, goal, setting):
        """One line; it is kept in `all` and printed."""
        label = meshes[0].stem if len(meshes) == 1 else f"{len(meshes)} models"
        row = Row("", label, goal.name, goal.seams, sum(map(count_triangles, meshes)))
        figures = Figures(label, setting, row.triangles)
        with tempfile.TemporaryDirectory(prefix="atlas-refine-bench-") as scratch:
            output = Path(scratch) / ("out.obj" if len(meshes) == 1 else "out")
            run = refine(self.program, meshes, output, goal)
            if run.done:
                outputs = [output] if len(meshes) == 1 else [output / mesh.name for mesh in meshes]
                fill_from_report(row, run.report)
                fill_from_check(row, meshes, outputs, goal, run.report)
                self.fill(figures, row, meshes, outputs)
            else:
                row.reason = run.message
        figures.reason = row.reason
        self.all.append((row, figures))
        print(line(figures), flush=True)

    def fill(self, figures, row, meshes, outputs):
        figures.bl_in, figures.e_d_in, figures.pe, figures.bl = row.bl_in, row.e_d_in, 100 * row.pe, row.bl
        figures.charts, figures.smallest, figures.small_charts = row.charts, 100 * row.smallest, row.small_charts
        figures.e_d, figures.e_2, figures.seconds = row.e_d, row.e_2, row.seconds
        if row.how == "cut":
            figures.stages = tuple(row.stages.get(stage, math.nan) for stage in ("align", "layout", "reduce"))
        if tuple(meshes) not in self.sae_of_input:
            self.sae_of_input[tuple(meshes)] = signal_error(one_after_the_other([read_obj(mesh) for mesh in meshes]))
        figures.sae_in = self.sae_of_input[tuple(meshes)]
        figures.sae = signal_error(one_after_the_other([read_obj(path) for path in outputs]))

    def modes(self):
        return [({"none": SQUEEZE, "rectangles": RECTANGLES}[seams], seams) for seams in self.arguments.seams]

    def sigma(self):
        for mesh in self.first("disk_deep"):
            for sigma in ("0.001", "0.004", "0.006"):
                self.run([mesh], with_options(RECTANGLES, "--sigma", sigma), f"sigma {sigma}")

    def bounds(self):
        for mesh in self.first("disk_deep"):
            for bound in (0.80, 0.85, 0.90):
                self.run([mesh], replace(OPTIMUM, bound=bound), f"bound {bound:.2f}")

    def gaps(self):
        for mesh in self.first("disk_deep"):
            self.run([mesh], with_options(RECTANGLES, "--gap", "0"), "gap 0")
            self.run([mesh], RECTANGLES, "gap")

    def collection(self):
        """The smallest models with one chart: together they have about as many triangles as the paper's."""
        models = list(self.meshes("disk"))[:COLLECTION]
        for goal, seams in self.modes():
            self.run(models, goal, seams)

    def sae(self):
        for mesh in self.first("disk_deep") + self.first("atlas-clean"):
            for goal, seams in self.modes():
                self.run([mesh], goal, seams)

    def statistics(self):
        for folder in ("disk", "disk_deep"):
            for mesh in self.meshes(folder):
                for goal, seams in self.modes():
                    self.run([mesh], goal, seams)
        for _, seams in self.modes():
            print("\n".join(["", *statistics_lines(seams, [(r, f) for r, f in self.all if r.seams == seams])]))


NAMES = ("sigma", "bounds", "gaps", "collection", "sae", "statistics")


def run_study(name, arguments, meshes):
    """Prints the study; returns the number of lines that went wrong."""
    study = Study(name, arguments, meshes)
    print(header())
    for figures in PAPER.get(name, []):
        print(line(figures))
    getattr(study, name)()
    rows = [
        row.as_json() | {"setting": figures.setting, "sae_in": figures.sae_in, "sae": figures.sae} for row, figures in study.all
    ]
    (arguments.out / f"study_{name}.json").write_text(json.dumps(rows, indent=1))
    wrong = sum(not row.ok for row, _ in study.all)
    print(f"\n{name}: {len(study.all) - wrong} of {len(study.all)} lines valid and at their bound")
    return wrong
