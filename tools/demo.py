"""The demo: a subdivided Suzanne in headless Blender, unwrapped by Blender, brought to PE 0.80 by the add-on's operator.

usage: demo.py OUT_DIR     writes before.png, after.png, tighter.png (0.90); in a square squeezed.png (seams none), needed4.png to
                           needed10.png (needed, within three budgets) and cut.png (rectangles); before.obj, after.obj,
                           suzanne.blend and table.txt
"""

import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

import blenders

NEEDED = (4, 7, 10)  # budgets of seams, per cent of the charts' boundary
ROOT = pathlib.Path(__file__).resolve().parent.parent


def draw(out, model, picture, title, *options):
    """The last stage of refining `model`.obj, drawn by the program, with its figures below; at the least bound it is drawn as it is."""
    with tempfile.TemporaryDirectory() as folder:
        command = [str(ROOT / "build" / "atlas-refine"), str(out / f"{model}.obj"), "-o", f"{folder}/refined.obj"]
        command += ["--density", "keep", "--svg", f"{folder}/svg", "--report", f"{folder}/report.json", *options]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
        last = max(pathlib.Path(folder, "svg").iterdir())
        stage = last.stem.split("-", 1)[1]
        drawn = last.read_text().replace(f">{stage}<", f">{title}<", 1)
        if stage != "input":
            report = json.loads(pathlib.Path(folder, "report.json").read_text())
            seams = f", seams +{100 * report['boundary_growth']:.0f} %, {report['seconds']['refine']:.1f} s"
            drawn = re.sub(r"(PE [0-9.]+ %, E_d [0-9.]+)", rf"\1{seams}", drawn, count=1)
        last.write_text(drawn)
        subprocess.run(["rsvg-convert", "--height", "700", str(last), "-o", str(out / f"{picture}.png")], check=True)


def main(out_dir):
    out = pathlib.Path(out_dir).resolve()
    out.mkdir(parents=True, exist_ok=True)
    (blender,) = blenders.debian()
    (archive,) = (ROOT / "dist").glob("atlas_refine-*.zip")
    with tempfile.TemporaryDirectory(prefix="atlas-refine-profile-") as profile:
        environment = {**os.environ, "BLENDER_USER_RESOURCES": profile}
        environment["PYTHONPATH"] = str(ROOT / "build" / "python")
        for script, argument in (("blender_tests/install_addon.py", archive), ("tools/demo_suzanne.py", out)):
            command = [*map(str, blender.script(ROOT / script)), str(argument)]
            done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
            if done.returncode != 0:
                sys.exit(f"{script} failed in {blender.name}:\n{done.stdout}{done.stderr}")
    draw(out, "before", "before", "Blender's unwrap", "--pe-bound", "0.01")
    draw(out, "after", "after", "refined to 0.80", "--pe-bound", "0.01")
    draw(out, "before", "tighter", "refined to 0.90", "--pe-bound", "0.90")
    square = ("--pe-bound", "0.80", "--aspect", "square")
    draw(out, "before", "squeezed", "squeezed to 0.80", *square)
    for percent in NEEDED:
        needed = ("--seams", "needed", "--seam-cost", "0", "--max-boundary-growth", str(0.01 * percent))
        draw(out, "before", f"needed{percent}", f"needed, up to {percent} % more boundary", *square, *needed)
    draw(out, "before", "cut", "cut into rectangles", *square, "--seams", "rectangles")
    print((out / "table.txt").read_text())
    pictures = ["before", "after", "tighter", "squeezed", *(f"needed{percent}" for percent in NEEDED), "cut"]
    for file in (*(f"{picture}.png" for picture in pictures), "suzanne.blend", "table.txt"):
        print(out / file)


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(sys.argv[1])
