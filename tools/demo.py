"""The demo: a subdivided Suzanne in headless Blender, unwrapped by Blender, brought to PE 0.80 by the add-on's operator.

usage: demo.py OUT_DIR     writes before.png, after.png, suzanne.blend and table.txt
"""

import os
import pathlib
import subprocess
import sys
import tempfile

import blenders

ROOT = pathlib.Path(__file__).resolve().parent.parent


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
    for picture in ("before", "after"):
        command = ["rsvg-convert", "--width", "1200", str(out / f"{picture}.svg"), "-o", str(out / f"{picture}.png")]
        subprocess.run(command, check=True)
        (out / f"{picture}.svg").unlink()
    print((out / "table.txt").read_text())
    for file in ("before.png", "after.png", "suzanne.blend", "table.txt"):
        print(out / file)


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(sys.argv[1])
