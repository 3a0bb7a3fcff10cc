"""Runs drive.py in a real Blender window on a virtual screen, with the add-on installed: run.py BLENDER RESULT.json [WORD]. Screenshots go
beside the result; only tests whose names hold the word are run. Of the word --five-clicks it is five_clicks.py, in a Blender without it."""

import os
import pathlib
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
SIZE = ("1600", "900")
FIVE_CLICKS = "--five-clicks"
TIMEOUT_SECONDS = 1200  # only what hangs takes as long


def start_screen():
    """An X server on a free display number of its own choice."""
    reader, writer = os.pipe()
    command = ["Xvfb", "-displayfd", str(writer), "-screen", "0", "x".join((*SIZE, "24")), "+extension", "GLX", "-noreset"]
    server = subprocess.Popen(command, pass_fds=[writer], stderr=subprocess.DEVNULL)
    os.close(writer)
    with os.fdopen(reader) as pipe:
        number = pipe.readline().strip()
    if not number:
        sys.exit("Xvfb does not start")
    return server, f":{number}"


def main(blender, result, *word):
    (archive,) = (ROOT / "dist").glob("atlas_refine-*.zip")
    server, display = start_screen()
    try:
        with tempfile.TemporaryDirectory(prefix="atlas-refine-profile-") as profile:
            environment = {**os.environ, "DISPLAY": display, "LIBGL_ALWAYS_SOFTWARE": "1", "BLENDER_USER_RESOURCES": profile}
            script = [HERE / "drive.py", "--", result, *word]
            if word == (FIVE_CLICKS,):
                script = [HERE / "five_clicks.py", "--", result, archive]
            else:
                install = [blender, "-b", "--factory-startup", "--python-exit-code", "1"]
                install += ["--python", HERE.parent / "install_addon.py", "--", archive]
                subprocess.run(install, env=environment, check=True)
            drive = [blender, "--factory-startup", "--enable-event-simulate", "--window-geometry", "0", "0", *SIZE]
            drive += ["--python", *script]
            return subprocess.run(drive, env=environment, check=False, timeout=TIMEOUT_SECONDS).returncode
    finally:
        server.terminate()
        server.wait()


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
