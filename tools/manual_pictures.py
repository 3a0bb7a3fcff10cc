"""Draws the pictures of docs/manual.md: runs the window tests that make them, cuts out what matters, and keeps them small.

usage: manual_pictures.py     with the add-on's zip in dist/
"""

import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
OUT = ROOT / "docs" / "manual"
#: In the window of 1600 x 900 pixels: width, height, left, top.
UV_MAP = "736x736+294+66"
PANEL = "196x754+1100+54"
VIEW = "720x456+300+216"
#: What becomes of which screenshots, beside each other, and how wide each is in the end.
PICTURES = {
    "before-and-after": (("manual-before", "manual-after"), UV_MAP, 420),
    "panel": (("manual-after",), PANEL, 196),
    "running": (("manual-running",), "196x190+1100+54", 196),
    "view": (("manual-3d-view",), VIEW, 560),
}
COLOURS = "64"


def main():
    OUT.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(prefix="atlas-refine-pictures-") as folder:
        result = pathlib.Path(folder) / "window.json"
        test = [sys.executable, ROOT / "blender_tests" / "window" / "run.py", "/usr/bin/blender", result, "manual"]
        subprocess.run(test, check=True)
        for name, (sources, crop, width) in PICTURES.items():
            files = [result.with_name(f"window-{source}.png") for source in sources]
            edit = ["-crop", crop, "+repage", "-resize", f"{width}x", "+append", "-dither", "None", "-colors", COLOURS, "-strip"]
            subprocess.run(["convert", *files, *edit, f"png8:{OUT / name}.png"], check=True)
            print(OUT / f"{name}.png")


if __name__ == "__main__":
    main()
