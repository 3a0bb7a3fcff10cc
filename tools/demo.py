"""The demo: a subdivided Suzanne in headless Blender, unwrapped by Blender, brought to PE 0.80 by the add-on's operator.

usage: demo.py OUT_DIR     writes before.png, after.png, tighter.png (0.90), before.obj, after.obj, suzanne.blend and table.txt
"""

import os
import pathlib
import subprocess
import sys
import tempfile

import blenders

ROOT = pathlib.Path(__file__).resolve().parent.parent


def draw(out, model, picture, pe_bound, title):
    """The last stage of refining `model`.obj to a bound, drawn by the program; a bound it holds already draws it as it is."""
    with tempfile.TemporaryDirectory() as folder:
        command = [str(ROOT / "build" / "atlas-refine"), str(out / f"{model}.obj"), "-o", f"{folder}/refined.obj"]
        command += ["--pe-bound", str(pe_bound), "--density", "keep", "--svg", f"{folder}/svg"]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
        last = max(pathlib.Path(folder, "svg").iterdir())
        stage = last.stem.split("-", 1)[1]
        last.write_text(last.read_text().replace(f">{stage}<", f">{title}<", 1))
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
    draw(out, "before", "before", 0.01, "Blender's unwrap")
    draw(out, "after", "after", 0.01, "refined to 0.80")
    draw(out, "before", "tighter", 0.90, "refined to 0.90")
    print((out / "table.txt").read_text())
    for file in ("before.png", "after.png", "tighter.png", "suzanne.blend", "table.txt"):
        print(out / file)


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(sys.argv[1])
