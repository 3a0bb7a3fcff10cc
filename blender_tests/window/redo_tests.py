"""Adjust Last Operation, in its dialog and in its panel: the window lives while the map is made anew."""

import sys

import bpy
import shapes
from driver import (
    STEP_SECONDS,
    click_at,
    drag,
    enter_edit_mode,
    finished,
    key,
    picture,
    running,
    slow_mesh,
    start,
    tasks,
    until,
    uv_editor,
    uvs,
    window,
)
from support import MODULE, add_mesh

USE_IN_DIALOG = (207, 73)  # from the place where the dialog is opened: the slider Texture Use
PANEL = (30, 20)  # Blender's own in the corner of the UV editor: its title,
USE_IN_PANEL = (190, 555)  # and the same slider once it is open


def place_of_dialog():
    return uv_editor().x + 400, uv_editor().y + 400


def dialog():
    """Opens it."""
    x, y = place_of_dialog()
    window().event_simulate("MOUSEMOVE", "NOTHING", x=x, y=y)
    yield 0.3
    yield from key("F9", over=(x, y))
    yield 1.0


def adjust(by):
    """Drags Texture Use by so many pixels."""
    x, y = place_of_dialog()
    yield from drag(x + USE_IN_DIALOG[0], y + USE_IN_DIALOG[1], by)


def away():
    """The dialog closes."""
    window().event_simulate("MOUSEMOVE", "NOTHING", x=uv_editor().x + 20, y=uv_editor().y + 800)
    yield 0.5


def adjusted():
    """The last operator's own, as the dialog shows it."""
    return bpy.context.window_manager.operators[-1].pe_bound


def use_is_as_adjusted():
    return finished() and tasks().last[0].result.bound_met and tasks().last[0].result.after.pe_fixed_aspect >= adjusted() - 1e-6


def test_adjusting_leaves_the_window_alive_and_esc_stops_it():
    obj = slow_mesh()
    before = uvs(obj)
    bpy.ops.ed.undo_push(message="Made a mesh")
    yield from start(obj)
    yield finished
    yield from dialog()
    yield from adjust(60)
    yield from until(lambda: adjusted() > 0.9, "the slider does not follow the mouse")
    yield running
    for _ in range(10):
        assert running(), "over too soon to be stopped"
        yield STEP_SECONDS
    picture("adjusting")
    yield from key("ESC", over=place_of_dialog())
    steps = 0
    while running():
        assert steps * STEP_SECONDS < 1.0, "0.5 s is promised, on a machine that has nothing else to do"
        yield STEP_SECONDS
        steps += 1
    print(f"Esc to the end of the run: {steps} steps of {STEP_SECONDS} s", flush=True)
    yield from away()
    assert uvs(bpy.data.objects["Slow"]).tobytes() == before.tobytes()


def test_adjusting_again_and_again_is_one_undo_step():
    obj = add_mesh(shapes.arcs(4, 60), name="Adjusted")
    before = uvs(obj)
    bpy.ops.ed.undo_push(message="Made a mesh")
    yield from start(obj, pe_bound=0.5)
    yield finished
    yield from dialog()
    seen = {uvs(bpy.data.objects["Adjusted"]).tobytes(), before.tobytes()}
    for by in (30, 20, -15):
        yield from adjust(by)
        yield use_is_as_adjusted
        seen.add(uvs(bpy.data.objects["Adjusted"]).tobytes())
    assert len(seen) == 5
    yield from away()
    yield from key("Z", ctrl=True)
    yield from until(lambda: uvs(bpy.data.objects["Adjusted"]).tobytes() == before.tobytes(), "one undo does not take it back")
    yield from key("Z", ctrl=True, shift=True)
    yield from until(lambda: uvs(bpy.data.objects["Adjusted"]).tobytes() in seen - {before.tobytes()}, "redo does nothing")


def test_adjusting_in_blenders_panel_which_stays_and_whose_last_value_counts():
    """In edit mode."""
    obj = slow_mesh()
    bpy.context.view_layer.objects.active = obj
    enter_edit_mode()
    bpy.ops.ed.undo_push(message="Made a mesh")
    tasks().last = None
    yield from start(obj)
    yield finished
    yield 0.5
    x, y = uv_editor().x, uv_editor().y
    yield from click_at(x + PANEL[0], y + PANEL[1])
    yield 0.5
    picture("adjust-panel")
    yield from drag(x + USE_IN_PANEL[0], y + USE_IN_PANEL[1], 60)
    yield from until(lambda: adjusted() > 0.9 and running(), "the slider does not follow the mouse")
    first = adjusted()
    yield from drag(x + USE_IN_PANEL[0], y + USE_IN_PANEL[1], -85)
    yield from until(lambda: adjusted() < first - 0.2, "the slider does not follow the mouse")
    yield use_is_as_adjusted
    yield 0.5
    picture("adjust-panel-after")
    assert any(region.type == "HUD" and region.width > 1 for region in uv_editor().regions), "the panel is gone"
    yield from click_at(x + PANEL[0], y + PANEL[1] + 700)
    bpy.ops.object.mode_set(mode="OBJECT")
    assert sys.modules[f"{MODULE}.again"].take() is None
