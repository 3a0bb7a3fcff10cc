"""In Blender's window: what the overlay draws and that it goes away, and Stop and Keep Best. Pictures of the manual are made here."""

import itertools
import sys

import bpy
import numpy as np
from driver import (
    MODULE,
    STEP_SECONDS,
    click,
    enter_edit_mode,
    finished,
    key,
    picture,
    running,
    seen,
    slow_mesh,
    start,
    tasks,
    until,
    uv_editor,
    uvs,
)
from support import add_mesh, get_uvs, set_uvs

#: Below the progress, while a refinement runs.
KEEP_BEST = (122, 104)
LAYERS = ("stretch", "seams", "gap")


def overlay():
    return bpy.context.window_manager.atlas_refine_overlay


def show(*layers):
    for layer in LAYERS:
        setattr(overlay(), layer, layer in layers)


def drawn(*layers):
    """Shows them, and waits until they are drawn: that is after they are built, between two drawings."""
    show(*layers)
    yield from until(lambda: sys.modules[f"{MODULE}.overlay"]._cache._built, "nothing is built")
    yield 0.5


def add_suzanne(subdivisions=1):
    """Alone, unwrapped by Smart UV Project."""
    for other in list(bpy.data.objects):
        bpy.data.objects.remove(other)
    bpy.ops.mesh.primitive_monkey_add(size=2.0)
    obj = bpy.context.object
    obj.name = "Suzanne"
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.mesh.subdivide(number_cuts=subdivisions)
    bpy.ops.uv.smart_project(island_margin=0.02)
    bpy.ops.object.mode_set(mode="OBJECT")
    return obj


def crowded(name="Crowded"):
    """Three charts in the texture's square, 1 px of 2048 apart: nearer than the margin; one of them is bent."""
    obj = add_mesh(name=name)
    layer = obj.data.uv_layers.active
    found = get_uvs(layer)
    corners = np.cumsum([0, 4 * 48, 4 * 36, 4 * 18])
    at = 0.01
    for begin, end in itertools.pairwise(corners):
        chart = found[begin:end]
        chart -= chart.min(axis=0)
        chart *= 0.3 / chart.max()
        chart += (at, 0.1)
        at = chart[:, 0].max() + 1 / 2048
    set_uvs(layer, found)
    return obj


def fit_view(operator, **options):
    """Of the editor that is the UV editor, or was."""
    area = max(bpy.context.window_manager.windows[0].screen.areas, key=lambda area: area.width * area.height)
    region = next(region for region in area.regions if region.type == "WINDOW")
    with bpy.context.temp_override(area=area, region=region):
        operator(**options)


def differs(one, other, least=0.1):
    """The part of the pixels that are not the same."""
    return float(np.mean(np.abs(one - other).max(axis=2) > least))


def like(pixels, colour, most=0.12):
    """The part of the pixels that have about this colour."""
    return float(np.mean(np.abs(pixels - np.asarray(colour)).max(axis=2) < most))


def preferences():
    return bpy.context.preferences.addons[MODULE].preferences


def test_overlay_stretch_and_borders_in_the_uv_editor():
    obj = crowded()
    preferences().heat_opacity = 1.0
    yield 0.5
    plain = seen("overlay-none", uv_editor())
    yield from drawn("stretch")
    heat = seen("overlay-stretch", uv_editor())
    assert differs(plain, heat) > 0.002
    assert like(heat, preferences().heat_high) > 0.0001
    yield from drawn("gap")
    near = seen("overlay-gap", uv_editor())
    assert like(near, preferences().near_colour) > 0.0001 > like(heat, preferences().near_colour)
    show()
    yield 0.5
    assert differs(plain, seen("overlay-off", uv_editor())) == 0
    preferences().heat_opacity = 0.7
    # What was near is not any more once it is refined.
    yield from start(obj, pe_bound=0.6)
    yield finished
    yield from drawn("gap")
    assert like(seen("overlay-gap-refined", uv_editor()), preferences().near_colour) == 0
    show()


def test_overlay_follows_the_mesh_the_selection_and_edit_mode():
    obj = crowded("Followed")
    yield 0.3
    show()
    yield 0.3
    empty = seen("overlay-empty", uv_editor())
    yield from drawn("stretch")
    shown = seen("overlay-followed", uv_editor())
    layer = obj.data.uv_layers.active
    set_uvs(layer, get_uvs(layer) + 0.2)
    obj.data.update()
    yield from until(lambda: differs(shown, seen("overlay-moved", uv_editor())) > 0.002, "it does not follow the UVs")
    obj.select_set(False)
    bpy.context.view_layer.objects.active = None
    yield from until(lambda: differs(empty, seen("overlay-deselected", uv_editor())) == 0, "it stays without an object")
    obj.select_set(True)
    bpy.context.view_layer.objects.active = obj
    enter_edit_mode()
    yield 0.5
    assert differs(empty, seen("overlay-edit-mode", uv_editor())) > 0.002
    bpy.ops.object.mode_set(mode="OBJECT")
    show()


def test_overlay_in_both_editors_and_pictures_of_the_manual():
    obj = add_suzanne()
    settings = bpy.context.scene.atlas_refine
    settings.seams, settings.cut = "RECTANGLES", "EDGES"
    tasks().last = None
    fit_view(bpy.ops.image.view_all, fit_view=True)
    yield from drawn("stretch")
    picture("manual-before")
    yield from start(obj, pe_bound=0.8)
    yield finished
    used = tasks().last[0].result.after.unit_square_share
    assert used >= 0.8, used
    show("stretch", "seams")
    for _ in range(12):  # the panel opens step by step, while it is drawn
        for region in uv_editor().regions:
            region.tag_redraw()
        yield 0.1
    after = seen("manual-after", uv_editor())
    settings.seams = "NONE"
    assert like(after, preferences().seam_colour, 0.2) > 0.0002
    area = uv_editor()
    area.ui_type = "VIEW_3D"
    area.spaces.active.show_region_ui = False
    area.spaces.active.overlay.show_outline_selected = False  # as orange as new seams
    fit_view(bpy.ops.view3d.view_axis, type="FRONT")
    fit_view(bpy.ops.view3d.view_selected)
    yield 1.0
    with_overlay = seen("manual-3d-view", area)
    assert like(with_overlay, preferences().seam_colour, 0.2) > 0.0002
    show()
    yield 0.5
    assert differs(with_overlay, seen("overlay-3d-view-none", area)) > 0.002
    area.ui_type = "UV"
    yield 0.5


def test_keep_best_by_the_key_as_in_the_manual():
    obj = slow_mesh()
    before = uvs(obj)
    bpy.ops.ed.undo_push(message="Made a mesh")
    tasks().last = None
    yield from start(obj, pe_bound=0.95)
    yield lambda: running() and tasks().running.is_solving and tasks().running.atlases[0].job.progress.pe > 0.4
    picture("manual-running")
    yield from key("RET")
    yield from until(lambda: not running(), "Enter does not end it")
    yield 1.0
    picture("manual-kept")
    result = tasks().last[0].result
    assert result.ended == "stopped", result.ended
    assert result.intervention == "squeezed"
    assert result.after.pe_fixed_aspect > 0.35
    assert uvs(bpy.data.objects[obj.name]).tobytes() != before.tobytes()
    yield from key("Z", ctrl=True)
    yield from until(lambda: uvs(bpy.data.objects["Slow"]).tobytes() == before.tobytes(), "one undo does not take it back")


def test_keep_best_by_the_button():
    obj = slow_mesh()
    tasks().last = None
    yield from start(obj, pe_bound=0.95)
    yield lambda: running() and tasks().running.is_solving and tasks().running.atlases[0].job.progress.pe > 0.4
    yield from click(KEEP_BEST)
    steps = 0
    while running():
        assert steps * STEP_SECONDS < 60, "the button does not end it"
        yield STEP_SECONDS
        steps += 1
    assert tasks().last[0].result.ended == "stopped"


def test_overlay_is_off_after_another_file():
    crowded("Old")
    yield from drawn(*LAYERS)
    bpy.ops.wm.save_as_mainfile(filepath=bpy.app.tempdir + "overlay.blend")
    bpy.ops.wm.open_mainfile(filepath=bpy.app.tempdir + "overlay.blend")
    yield 0.5
    assert not any(getattr(overlay(), layer) for layer in LAYERS)
