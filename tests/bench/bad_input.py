"""Input and usage that cannot be: exit code, message, and that nothing was written."""

import subprocess
import tempfile
from dataclasses import dataclass
from pathlib import Path

QUAD = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
GOOD = QUAD + "f 1/1 2/2 3/3 4/4\n"
OLD = "the old file"


@dataclass(frozen=True)
class Case:
    """One call in a folder of its own, which holds in.obj and an old out.obj."""

    what: str
    exit_code: int
    text: str | None = GOOD  # of in.obj, "directory" where that is one, None where there is none
    options: tuple = ()
    output: str = "out.obj"
    weights: str | None = None  # text of weights.txt

    def run(self, program, folder):
        mesh = folder / "in.obj"
        if self.text == "directory":
            mesh.mkdir()
        elif self.text is not None:
            mesh.write_text(self.text)
        if self.weights is not None:
            (folder / "weights.txt").write_text(self.weights)
        command = [program, "in.obj", "-o", self.output, *self.options]
        return subprocess.run(command, capture_output=True, timeout=60, check=False, cwd=folder)


def cut(what, *options):
    return Case(what, 2, options=("--seams", "rectangles", *options))


def weighted(what, text):
    """Wrong weights are refused with cuts and without."""
    return [
        Case(f"importance, seams {seams}: {what}", 3, weights=text, options=("--importance", "weights.txt", "--seams", seams))
        for seams in ("none", "rectangles")
    ]


CASES = (
    Case("missing file", 3, None),
    Case("a directory", 3, "directory"),
    Case("no UVs", 3, QUAD + "f 1 2 3 4\n"),
    Case("NaN position", 3, GOOD.replace("v 1 1 0", "v nan 1 0")),
    Case("NaN UV", 3, GOOD.replace("vt 1 1", "vt 1 nan")),
    Case("vertex index out of range", 3, QUAD + "f 1/1 2/2 9/3\n"),
    Case("UV index out of range", 3, QUAD + "f 1/1 2/2 3/9\n"),
    Case("empty file", 3, ""),
    Case("mesh without faces", 3, QUAD),
    Case("truncated file", 3, (GOOD + GOOD)[: len(GOOD) - 7]),
    Case("bound 0", 2, options=("--pe-bound", "0")),
    Case("bound 1", 2, options=("--pe-bound", "1")),
    Case("bound 1.2", 2, options=("--pe-bound", "1.2")),
    Case("unknown option", 2, options=("--unknown",)),
    Case("output folder does not exist", 2, output="missing/out.obj"),
    Case("unknown seams", 2, options=("--seams", "some")),
    cut("negative sigma", "--sigma", "-0.004"),
    cut("sigma 0", "--sigma", "0"),
    cut("omega above 1", "--omega", "1.5"),
    cut("negative omega", "--omega", "-0.1"),
    cut("zero candidates", "--candidates", "0"),
    cut("half a candidate", "--candidates", "0.5"),
    Case("sigma without rectangles", 2, options=("--sigma", "0.004")),
    Case("until-input without rectangles", 2, options=("--until-input",)),
    Case("unknown reference", 2, options=("--reference", "uv")),
    *weighted("no file", None),
    *weighted("too few", ""),
    *weighted("too many", "1\n1\n"),
    *weighted("zero", "0\n"),
    *weighted("negative", "-1\n"),
    *weighted("a word", "much\n"),
    Case("two inputs of one name", 2, options=("in.obj",), output="folder"),
    Case("several inputs, one output", 2, options=("other.obj",)),
    Case("one of several inputs is missing", 3, options=("other.obj",), output="folder"),
)


def bad_input_lines(program):
    """(lines, number of cases that went wrong)."""
    lines, wrong = [], 0
    for case in CASES:
        with tempfile.TemporaryDirectory(prefix="atlas-refine-bench-") as scratch:
            folder = Path(scratch)
            old = folder / "out.obj"
            old.write_text(OLD)
            run = case.run(program, folder)
            expected = {"out.obj"} | ({"in.obj"} if case.text is not None else set())
            expected |= {"weights.txt"} if case.weights is not None else set()
            untouched = {path.name for path in folder.rglob("*")} == expected and old.read_text() == OLD
            message = run.stderr.decode(errors="replace")
            good = run.returncode == case.exit_code and message.count("\n") == 1 and untouched
        wrong += not good
        files = "files untouched" if untouched else "FILES CHANGED"
        exits = f"exit {run.returncode} (asked {case.exit_code})"
        lines.append(f"{'ok' if good else 'WRONG':6} {case.what:42} {exits}, {files}: {message.strip()}")
    return lines, wrong
