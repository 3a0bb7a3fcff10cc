# SPDX-License-Identifier: GPL-3.0-or-later
"""What is drawn over UV editor and 3D view: stretch of the faces, the last run's new seams, borders nearer than the margin.

Batches are built when a mesh, its UVs or a setting that they show has changed, and drawn as they are until then."""

import time

import bpy
import gpu
from gpu_extras.batch import batch_for_shader
from mathutils import Matrix

from . import engine, preferences, tasks
from .bridge import mesh as bridge
from .bridge import parts as objects
from .bridge import versions
from .bridge.texture import find_texture
from .changes import Watch
from .core.overlay import Look, Source, picture_of
from .drawing import redraw_panels, redraw_views
from .properties import to_options

#: While a mesh is being changed it is drawn anew no more often than takes this part of the time.
BUSY_PART = 0.2
SEAM_WIDTH, NEAR_WIDTH = 3.0, 5.0
#: The 3D view's batches are drawn so much nearer to the viewer than the faces that they lie on, as a part of the distance: lines more,
#: of whose width one half would else lie below a face that comes towards the viewer.
NEARER, NEARER_LINES = 0.002, 0.006

#: Which layers are shown. Of this run of Blender: no file keeps it.
shown = {"stretch": False, "seams": False, "gap": False}


class Batches:
    """One object's, ready to draw."""

    def __init__(self, picture):
        faces, lines = versions.shader("FLAT_COLOR"), versions.shader("POLYLINE_UNIFORM_COLOR")
        self.faces = {
            where: batch_for_shader(faces, "TRIS", {"pos": points, "color": picture.colours})
            for where, points in picture.faces.items()
            if len(points)
        }
        self.lines = {
            (layer, where): batch_for_shader(lines, "LINES", {"pos": points})
            for layer, places in picture.lines.items()
            for where, points in places.items()
            if len(points)
        }


class Cache:
    """The batches of the objects that are looked at, by name, and what they were built for."""

    def __init__(self):
        self.clear()

    def clear(self):
        self.batches, self.key, self.stale, self.not_before = {}, None, True, 0.0

    def of(self, context):
        found = [obj for obj in objects.objects_of(context) if not objects.why_not(obj)]
        key = _key(context, found)
        if key != self.key or (self.stale and time.monotonic() >= self.not_before):
            began = time.monotonic()
            self.batches = _build(context, found)
            self.key, self.stale = key, False
            took = time.monotonic() - began
            self.not_before = began + took / BUSY_PART
        elif self.stale and not bpy.app.timers.is_registered(redraw_views):
            bpy.app.timers.register(redraw_views, first_interval=max(self.not_before - time.monotonic(), 0.01))
        return self.batches


_cache = Cache()
_handles = []


def show(layer, on):
    """Draws a layer, or no longer does; with none left nothing of the overlay remains."""
    shown[layer] = on
    _cache.clear()
    if any(shown.values()) and not _handles:
        for space, draw in ((bpy.types.SpaceImageEditor, _draw_in_uv_editor), (bpy.types.SpaceView3D, _draw_in_3d_view)):
            _handles.append((space, space.draw_handler_add(draw, (), "WINDOW", "POST_VIEW")))
    if not any(shown.values()):
        _remove()
    redraw_views()
    redraw_panels(bpy.context)


def _remove():
    for space, handle in _handles:
        space.draw_handler_remove(handle, "WINDOW")
    _handles.clear()
    _cache.clear()


def _look(context, obj):
    options = to_options(context.scene.atlas_refine)
    texture = find_texture(context, obj)
    margin = options.gap_px if options.gap == "PIXELS" else 0.0
    chosen = preferences.get()
    return Look(
        layers=tuple(layer for layer, on in shown.items() if on),
        texture_size=options.texture_pixels(texture),
        margin_px=margin,
        to_border=options.aspect != "FREE",
        keeps_stacks=options.stacks == "KEEP",
        low=tuple(chosen.heat_low),
        high=tuple(chosen.heat_high),
        worst=chosen.heat_worst,
        opacity=chosen.heat_opacity,
    )


def _key(context, found):
    """What the batches depend on besides the meshes themselves."""
    uv_map = context.scene.atlas_refine.uv_map
    names = tuple((obj.name, obj.mode, _map_of(obj, uv_map)) for obj in found)
    return names, id(tasks.last), _look(context, found[0]) if found else None


def _map_of(obj, wanted):
    try:
        return bridge.find_uv_map(obj.data, wanted)
    except bridge.MeshError:
        return ""


def _build(context, found):
    uv_map = context.scene.atlas_refine.uv_map
    sources = {obj.name: _source(obj, uv_map, context.view_layer.depsgraph) for obj in found}
    sources = {name: source for name, source in sources.items() if source is not None}
    if not sources:
        return {}
    pictures = picture_of(engine.module, list(sources.values()), _look(context, found[0]))
    return {name: Batches(picture) for name, picture in zip(sources, pictures, strict=True)}


def _source(obj, uv_map, depsgraph):
    """None for a mesh that cannot be read, of which the operators say why."""
    try:
        atlas = bridge.read_atlas(obj, bridge.find_uv_map(obj.data, uv_map))
    except bridge.MeshError:
        return None
    triangles, shown = bridge.read_triangles(obj), bridge.read_shown_positions(obj, depsgraph)
    return Source(atlas, triangles, objects.scale_of(obj), tasks.new_seams(obj.name), shown)


def _draw_in_uv_editor():
    context = bpy.context
    if context.space_data.mode != "UV":
        return
    gpu.state.blend_set("ALPHA")
    for batches in _cache.of(context).values():
        _draw_faces(batches, "uv")
        _draw_lines(context, batches, "uv")
    gpu.state.blend_set("NONE")


def _draw_in_3d_view():
    context = bpy.context
    if context.mode not in {"OBJECT", "EDIT_MESH"} or not context.space_data.overlay.show_overlays:
        return
    gpu.state.blend_set("ALPHA")
    gpu.state.depth_test_set("LESS_EQUAL")
    for name, batches in _cache.of(context).items():
        obj = bpy.data.objects.get(name)
        if obj is None or not obj.visible_get():
            continue
        with gpu.matrix.push_pop():
            gpu.matrix.load_matrix(_nearer(context.region_data, NEARER) @ obj.matrix_world)
            _draw_faces(batches, "space")
            gpu.matrix.load_matrix(_nearer(context.region_data, NEARER_LINES) @ obj.matrix_world)
            _draw_lines(context, batches, "space")
    gpu.state.depth_test_set("NONE")
    gpu.state.blend_set("NONE")


def _nearer(view, part):
    """The view's matrix, with everything nearer to the viewer by a part of the distance and at the same place of the screen."""
    if view.is_perspective:
        return Matrix.Scale(1 - part, 4) @ view.view_matrix
    return Matrix.Translation((0, 0, part * view.view_distance)) @ view.view_matrix


def _draw_faces(batches, where):
    if where in batches.faces:
        batches.faces[where].draw(versions.shader("FLAT_COLOR"))


def _draw_lines(context, batches, where):
    chosen = preferences.get()
    lines = versions.shader("POLYLINE_UNIFORM_COLOR")
    for layer, width, colour in (("seams", SEAM_WIDTH, chosen.seam_colour), ("gap", NEAR_WIDTH, chosen.near_colour)):
        batch = batches.lines.get((layer, where))
        if batch is None:
            continue
        lines.bind()
        lines.uniform_float("viewportSize", (context.region.width, context.region.height))
        lines.uniform_float("lineWidth", width)
        lines.uniform_float("color", (*colour, 1.0))
        batch.draw(lines)


def _changed():
    _cache.stale = True


def _switch_off():
    for layer in shown:
        shown[layer] = False
    _remove()


_watch = Watch(_switch_off, _changed, is_needed=lambda: _handles)


def register():
    _watch.register()


def unregister():
    _switch_off()
    if bpy.app.timers.is_registered(redraw_views):
        bpy.app.timers.unregister(redraw_views)
    _watch.unregister()
