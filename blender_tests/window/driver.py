"""Mouse, keys, pictures and waiting, for tests in Blender's window.

Each test is a generator: it yields how many seconds to wait for, or a condition to wait for.
"""

import os
import pathlib
import subprocess
import sys
import time

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent), str(HERE.parent.parent / "tests" / "python")]

import bmesh
import bpy
import numpy as np
import shapes
from support import MODULE, add_mesh, get_uvs

ARGUMENTS = sys.argv[sys.argv.index("--") + 1 :]
RESULT = pathlib.Path(ARGUMENTS[0])
WORD = "".join(ARGUMENTS[1:])  # only tests whose names hold it
STEP_SECONDS = 0.05
WAIT_LIMIT_SECONDS = 240  # only what hangs takes as long
#: Where things are in the sidebar of Blender 3.4.1's UV editor, in pixels from its right and top edge.
TAB = (10, 130)
SEAMS = (84, 156)
BUTTON = (122, 80)
SHOW_TRADE_OFF = (125, 543)
THIRD_USE = (61, 638)  # of the lines of a trade-off
TAB_3D = 138  # the same tab in the 3D view, from the top edge, where no object is active
ROW = 23


def slow_mesh():
    """Takes the engine several seconds."""
    return add_mesh(shapes.slow(), name="Slow")


def window():
    return bpy.context.window_manager.windows[0]


def uv_editor():
    return next(area for area in window().screen.areas if area.type == "IMAGE_EDITOR")


def tasks():
    return sys.modules[f"{MODULE}.tasks"]


def point(offset):
    region = next(region for region in uv_editor().regions if region.type == "UI")
    return region.x + region.width - offset[0], region.y + region.height - offset[1]


def click(offset):
    yield from click_at(*point(offset))


def click_at(x, y, of=None):
    of = of or window()
    of.event_simulate("MOUSEMOVE", "NOTHING", x=x, y=y)
    yield 0.2
    of.event_simulate("LEFTMOUSE", "PRESS", x=x, y=y)
    yield 0.1
    of.event_simulate("LEFTMOUSE", "RELEASE", x=x, y=y)
    yield 0.2


def drag(x, y, by):
    """To the right, in several moves."""
    window().event_simulate("MOUSEMOVE", "NOTHING", x=x, y=y)
    yield 0.3
    window().event_simulate("LEFTMOUSE", "PRESS", x=x, y=y)
    yield 0.1
    for k in range(1, 6):
        window().event_simulate("MOUSEMOVE", "NOTHING", x=x + k * by // 5, y=y)
        yield 0.05
    window().event_simulate("LEFTMOUSE", "RELEASE", x=x + by, y=y)
    yield 0.1


def key(name, over=None, **modifiers):
    x, y = over or point(BUTTON)
    window().event_simulate(name, "PRESS", x=x, y=y, **modifiers)
    yield 0.05
    window().event_simulate(name, "RELEASE", x=x, y=y, **modifiers)


def picture(name):
    path = RESULT.with_name(f"window-{name}.png")
    subprocess.run(["import", "-window", "root", path], check=False, env=os.environ)
    return path


def seen(name, area):
    """What the window shows in an area's main region, left of the sidebar and above the last operator's panel, as (height,
    width, 3) floats; kept as a picture."""
    region = next(region for region in area.regions if region.type == "WINDOW")
    right = min([region.x + region.width, *(side.x for side in area.regions if side.type == "UI" and side.width > 1)])
    image = bpy.data.images.load(str(picture(name)))
    width, height = image.size
    pixels = np.array(image.pixels[:], dtype=np.float32).reshape(height, width, 4)
    bpy.data.images.remove(image)
    return pixels[region.y + 100 : region.y + region.height, region.x : right, :3]


def uvs(obj):
    return get_uvs(obj.data.uv_layers.active)


def mesh_size(name):
    mesh = bpy.data.objects[name].data
    return len(mesh.polygons), len(mesh.vertices)


def faces_in_edit_mode(name):
    return len(bmesh.from_edit_mesh(bpy.data.objects[name].data).faces)


def until(condition, otherwise):
    """Waits for what an event brings about."""
    began = time.monotonic()
    while not condition():
        assert time.monotonic() - began < WAIT_LIMIT_SECONDS, otherwise
        yield STEP_SECONDS


def running():
    return tasks().running is not None


def finished():
    return tasks().last is not None and not running()


def enter_edit_mode():
    """With everything selected."""
    bpy.context.scene.tool_settings.use_uv_select_sync = True
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="SELECT")


def start(obj, pe_bound=0.8):
    bpy.context.view_layer.objects.active = obj
    bpy.context.scene.atlas_refine.pe_bound = pe_bound
    # Off the button, as for setting it by hand: Blender keeps a button that the pointer is on as it was drawn.
    window().event_simulate("MOUSEMOVE", "NOTHING", x=300, y=200)
    yield 0.3
    uv_editor().tag_redraw()
    yield 0.3
    yield from click(BUTTON)


def prepare():
    for obj in list(bpy.data.objects):
        bpy.data.objects.remove(obj)
    area = max(window().screen.areas, key=lambda area: area.width * area.height)
    area.ui_type = "UV"
    area.spaces.active.show_region_ui = True
    yield 1.0
    yield from click(TAB)
    yield 0.5


def wait(step):
    """One step of a generator as seconds to wait."""
    if not callable(step):
        yield step
        return
    began = time.monotonic()
    while not step():
        if time.monotonic() - began > WAIT_LIMIT_SECONDS:
            raise TimeoutError("waited in vain")
        yield STEP_SECONDS
