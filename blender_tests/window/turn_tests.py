"""How long the window waits for the add-on at once, in processor time of its thread."""

import sys
import time
from dataclasses import replace

import bmesh
import bpy
import shapes
from driver import STEP_SECONDS, enter_edit_mode, running, tasks
from support import MODULE, add_mesh, get_uvs

MOST_SECONDS = 0.2  # 0.1 s is promised, on a machine that has nothing else to do
QUADS = 183**2  # of each of three charts


class Turns:
    """What each call of the operator's own functions takes."""

    def __init__(self, name):
        self._operator = getattr(sys.modules[f"{MODULE}.operators"], f"UV_OT_{name}")
        self._kept = {name: getattr(self._operator, name) for name in ("invoke", "modal")}
        self.seconds = []

    def __enter__(self):
        for name, function in self._kept.items():
            setattr(self._operator, name, self._timed(function))
        return self

    def __exit__(self, *_):
        for name in self._kept:
            delattr(self._operator, name)

    def _timed(self, function):
        def timed(operator, context, event):  # Blender counts the arguments
            began = time.thread_time()
            try:
                return function(operator, context, event)
            finally:
                self.seconds.append(time.thread_time() - began)

        return timed


def large_mesh():
    side = round(QUADS**0.5)
    charts = [shapes.grid(side, side, scale=0.5 / side, origin=(0.6 * k, 0.0), bend=0.6) for k in range(3)]
    return add_mesh(shapes.join(*charts), name="Large")


def timed(what, mode, **options):
    with Turns(what) as turns:
        assert getattr(bpy.ops.uv, what)("INVOKE_DEFAULT", **options) == {"RUNNING_MODAL"}
        yield lambda: not running()
    longest, total = max(turns.seconds), sum(turns.seconds)
    print(
        f"{what}, {mode}: the window waits {longest:.3f} s at once, {total:.3f} s in all, {len(turns.seconds)} turns", flush=True
    )
    assert longest < MOST_SECONDS


def measured(mode, pe_bound, intervention="squeezed", **options):
    tasks().last = None
    yield from timed("atlas_refine", mode, pe_bound=pe_bound, **options)
    assert tasks().last[0].result.intervention == intervention, tasks().last[0].result.intervention


def test_the_window_never_waits_for_long():
    obj = large_mesh()
    bpy.context.view_layer.objects.active = obj
    yield from measured("object mode", 0.7)
    enter_edit_mode()
    yield from measured("edit mode", 0.9)
    bpy.ops.object.mode_set(mode="OBJECT")
    bpy.data.objects.remove(obj)


def test_the_window_does_not_wait_for_cuts_across_faces():
    how = {"seams": "RECTANGLES", "cut": "SPLIT", "aspect": "SQUARE", "intervention": "cut"}
    for mode in ("object mode", "edit mode"):
        bpy.context.view_layer.update()  # the last one's object is gone
        obj = large_mesh()
        bpy.context.view_layer.objects.active = obj
        if mode == "edit mode":
            enter_edit_mode()
        yield from measured(mode, 0.95, **how)
        bpy.ops.object.mode_set(mode="OBJECT")
        assert len(obj.data.polygons) > 3 * QUADS
        bpy.data.objects.remove(obj)


def adjusted(pe_bound):
    """As by Adjust Last Operation, without the panel."""
    again, operators, properties = (sys.modules[f"{MODULE}.{name}"] for name in ("again", "operators", "properties"))
    options = replace(properties.to_options(bpy.context.scene.atlas_refine), pe_bound=pe_bound)
    again.ask(bpy.context, operators.trade_off.picked(options, None))
    yield running


def test_the_window_does_not_wait_for_what_is_adjusted():
    for mode in ("object mode", "edit mode"):
        bpy.context.view_layer.update()
        obj = large_mesh()
        bpy.context.view_layer.objects.active = obj
        if mode == "edit mode":
            enter_edit_mode()
        tasks().last = None
        with Turns("atlas_refine_again") as turns:
            yield from adjusted(0.7)
            yield lambda: not running()
        print(f"adjusted, {mode}: the window waits {max(turns.seconds):.3f} s at once", flush=True)
        assert max(turns.seconds) < MOST_SECONDS
        assert tasks().last[0].result.bound_met
        bpy.ops.object.mode_set(mode="OBJECT")
        bpy.data.objects.remove(obj)


def test_undo_while_what_was_adjusted_is_read_or_written():
    """As another value brings it: meshes that are half read or written are let go before undo replaces them."""
    for reads in (True, False):
        bpy.context.view_layer.update()
        obj = large_mesh()
        before = get_uvs(obj.data.uv_layers.active).tobytes()
        bpy.context.view_layer.objects.active = obj
        enter_edit_mode()
        bpy.ops.ed.undo_push(message="Made a mesh")
        bpy.ops.ed.undo_push(message="Something")
        meshes = len(bpy.data.meshes)
        yield from adjusted(0.7)
        run = tasks().running
        if not reads:
            yield lambda run=run: run.done
            yield STEP_SECONDS
        assert running(), "over too soon"
        assert not run.is_solving
        with bpy.context.temp_override(window=bpy.context.window_manager.windows[0]):
            bpy.ops.ed.undo()
        assert tasks().running is None
        yield 0.5
        assert len(bpy.data.meshes) <= meshes
        bpy.ops.object.mode_set(mode="OBJECT")
        obj = bpy.data.objects["Large"]
        assert get_uvs(obj.data.uv_layers.active).tobytes() == before
        bpy.data.objects.remove(obj)


def test_the_window_does_not_wait_for_a_look():
    bpy.context.view_layer.update()  # the last test's object is gone
    obj = large_mesh()
    bpy.context.view_layer.objects.active = obj
    tasks().last = None
    yield from timed("atlas_refine_measure", "object mode")
    assert tasks().last[0].measures.chart_count == 3
    enter_edit_mode()
    yield from timed("atlas_refine_measure", "edit mode")
    yield from timed("atlas_refine_select_problems", "edit mode")
    assert not any(face.select for face in bmesh.from_edit_mesh(obj.data).faces)
    bpy.ops.object.mode_set(mode="OBJECT")
    bpy.data.objects.remove(obj)


def test_esc_while_meshes_are_read():
    obj = large_mesh()
    bpy.context.view_layer.objects.active = obj
    tasks().last = None
    meshes = len(bpy.data.meshes)
    enter_edit_mode()
    assert bpy.ops.uv.atlas_refine("INVOKE_DEFAULT") == {"RUNNING_MODAL"}
    run = tasks().running
    assert not run.is_solving
    run.cancel()
    yield lambda: tasks().running is None
    assert len(bpy.data.meshes) == meshes
    assert not run.atlases
    bpy.ops.object.mode_set(mode="OBJECT")
    bpy.data.objects.remove(obj)
