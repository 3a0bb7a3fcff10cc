"""Input and usage that cannot be: exit code, message, and that nothing was written."""

import subprocess
import tempfile
from pathlib import Path

QUAD = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
GOOD = QUAD + "f 1/1 2/2 3/3 4/4\n"
OLD = "the old file"

# what, text of the input (None: there is none), options, output, exit code
CASES = (
    ("missing file", None, [], "out.obj", 3),
    ("a directory", "directory", [], "out.obj", 3),
    ("no UVs", QUAD + "f 1 2 3 4\n", [], "out.obj", 3),
    ("NaN position", GOOD.replace("v 1 1 0", "v nan 1 0"), [], "out.obj", 3),
    ("NaN UV", GOOD.replace("vt 1 1", "vt 1 nan"), [], "out.obj", 3),
    ("vertex index out of range", QUAD + "f 1/1 2/2 9/3\n", [], "out.obj", 3),
    ("UV index out of range", QUAD + "f 1/1 2/2 3/9\n", [], "out.obj", 3),
    ("empty file", "", [], "out.obj", 3),
    ("mesh without faces", QUAD, [], "out.obj", 3),
    ("truncated file", (GOOD + GOOD)[: len(GOOD) - 7], [], "out.obj", 3),
    ("bound 0", GOOD, ["--pe-bound", "0"], "out.obj", 2),
    ("bound 1", GOOD, ["--pe-bound", "1"], "out.obj", 2),
    ("bound 1.2", GOOD, ["--pe-bound", "1.2"], "out.obj", 2),
    ("unknown option", GOOD, ["--unknown"], "out.obj", 2),
    ("output folder does not exist", GOOD, [], "missing/out.obj", 2),
)


def bad_input_lines(program):
    """(lines, number of cases that went wrong)."""
    lines, wrong = [], 0
    for what, text, options, output, expected in CASES:
        with tempfile.TemporaryDirectory(prefix="atlas-refine-bench-") as scratch:
            folder = Path(scratch)
            mesh, old = folder / "in.obj", folder / "out.obj"
            if text == "directory":
                mesh.mkdir()
            elif text is not None:
                mesh.write_text(text)
            old.write_text(OLD)
            before = sorted(folder.rglob("*"))
            command = [program, mesh, "-o", folder / output, *options]
            run = subprocess.run(command, capture_output=True, timeout=60, check=False)
            untouched = sorted(folder.rglob("*")) == before and old.read_text() == OLD
            message = run.stderr.decode(errors="replace")
            good = run.returncode == expected and message.count("\n") == 1 and untouched
        wrong += not good
        said = message.strip().replace(scratch + "/", "")
        files = "files untouched" if untouched else "FILES CHANGED"
        lines.append(f"{'ok' if good else 'WRONG':6} {what:30} exit {run.returncode} (asked {expected}), {files}: {said}")
    return lines, wrong
