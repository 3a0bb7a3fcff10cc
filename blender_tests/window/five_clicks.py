"""From the zip to a refined object by clicks alone, as docs/manual.md has it: a Blender as it comes, which has never seen the add-on.

After `--`: RESULT.json, the zip.
"""

import json
import os
import pathlib
import sys
import traceback

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

import bpy
import driver
from driver import ARGUMENTS, RESULT, click_at, finished, key, picture, tasks, until, uvs
from support import MODULE

# In Blender 3.4.1, in pixels from the left and from the top edge of the window that holds it:
PREFERENCES = ((82, 14), (134, 309))  # the menu Edit and its last line
ADD_ONS, INSTALL, TICK = (60, 190), (535, 18), (211, 75)
INSTALL_ADD_ON = (1031, 603)
CUBE = (660, 433)
TAB, REFINE = (1311, 260), (1195, 150)
SETTLED = 0.7  # what was clicked is drawn


def windows():
    return bpy.context.window_manager.windows


def click(place, number=0):
    """Of the windows, in the order in which they were opened."""
    yield from click_at(place[0], windows()[number].height - place[1], windows()[number])
    yield SETTLED


def install(archive):
    for place in PREFERENCES:
        yield from click(place)
    yield from until(lambda: len(windows()) == 2, "the preferences do not open")
    yield from click(ADD_ONS, 1)
    yield from until(lambda: bpy.context.preferences.active_section == "ADDONS", "Add-ons are elsewhere")
    yield from click(INSTALL, 1)
    yield from until(lambda: len(windows()) == 3, "there is no file browser")
    chosen = windows()[2].screen.areas[0].spaces.active.params
    chosen.directory, chosen.filename = os.fsencode(archive.parent), archive.name
    yield from click(INSTALL_ADD_ON, 2)
    yield from until(lambda: len(windows()) == 2, "the file browser stays")
    picture("five-installed")
    yield from click(TICK, 1)
    yield from until(lambda: MODULE in bpy.context.preferences.addons, "the add-on is not enabled")
    with bpy.context.temp_override(window=windows()[1]):  # its frame is the desktop's, which is not there
        bpy.ops.wm.window_close()
    yield SETTLED


def from_the_zip_to_the_result(archive):
    obj = bpy.data.objects["Cube"]
    before = uvs(obj)
    yield from install(archive)
    yield from click(CUBE)
    yield from key("N", over=(CUBE[0], windows()[0].height - CUBE[1]))
    yield SETTLED
    yield from click(TAB)
    picture("five-tab")
    yield from click(REFINE)
    yield from until(finished, "there is no result")
    yield 2 * SETTLED  # the panel slides open
    picture("five-done")
    assert tasks().last[0].result.after.pe_fixed_aspect >= 0.8 - 1e-9
    assert uvs(bpy.data.objects["Cube"]).tobytes() != before.tobytes()
    yield from key("Z", over=(CUBE[0], windows()[0].height - CUBE[1]), ctrl=True)
    yield from until(lambda: uvs(bpy.data.objects["Cube"]).tobytes() == before.tobytes(), "one undo does not take it back")


def drive():
    yield 1.0
    try:
        for step in from_the_zip_to_the_result(pathlib.Path(ARGUMENTS[1]).resolve()):
            yield from driver.wait(step)
        print("from the zip to the result ... ok", flush=True)
        failed = 0
    except Exception:
        print(f"from the zip to the result ... FAIL\n{traceback.format_exc()}", flush=True)
        picture("five-failed")
        failed = 1
    RESULT.write_text(json.dumps({"passed": 1 - failed, "failed": failed, "skipped": []}))
    os._exit(failed)


steps = drive()
bpy.context.preferences.view.show_splash = False
bpy.app.timers.register(lambda: next(steps), first_interval=0.5, persistent=True)
