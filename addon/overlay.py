# SPDX-License-Identifier: GPL-3.0-or-later
"""What is drawn over UV editor and 3D view: stretch of the faces, the last run's new seams, borders nearer than the margin.

Batches are built when a mesh, its UVs or a setting that they show has changed, and drawn as they are until then."""

import time
from dataclasses import dataclass
from functools import cached_property

import bpy
import gpu
import numpy as np
from gpu_extras.batch import batch_for_shader
from mathutils import Matrix

from . import engine, preferences, tasks
from .bridge import mesh as bridge
from .bridge import parts as objects
from .bridge import versions
from .bridge.texture import find_texture, texture_of_material
from .changes import Watch, no_longer, once_drawn
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
    """One object's, made when they are first drawn."""

    def __init__(self, picture):
        self._picture = picture

    @cached_property
    def faces(self):
        shader = versions.shader("FLAT_COLOR")
        return {
            where: batch_for_shader(shader, "TRIS", {"pos": points, "color": self._picture.colours[where]})
            for where, points in self._picture.faces.items()
            if len(points)
        }

    @cached_property
    def lines(self):
        shader = versions.shader("POLYLINE_UNIFORM_COLOR")
        return {
            (layer, where): batch_for_shader(shader, "LINES", {"pos": points})
            for layer, places in self._picture.lines.items()
            for where, points in places.items()
            if len(points)
        }


@dataclass(frozen=True)
class Wanted:
    """What batches are built of, besides the meshes themselves, by name: undo and other files replace Blender's data."""

    scene: str
    view_layer: str
    objects: tuple  # (name, mode, UV map) of each
    last: int  # which result the panel shows
    look: Look
    materials: tuple  # names, by the number of their box, where each has its own texture
    by_object: bool  # each object has


class Cache:
    """The batches of the objects that are looked at, by name, for each of the last Wanted: editors may show different images. They
    are built between two drawings, since reading makes data; meanwhile what was built before is drawn."""

    MOST = 4

    def __init__(self):
        self.clear()

    def clear(self):
        self._built, self._asked, self._latest, self._not_before = {}, {}, {}, 0.0

    def outdate(self):
        """The meshes have changed."""
        self._built.clear()

    def of(self, wanted):
        if wanted in self._built:
            return self._built[wanted]
        self._asked[wanted] = None
        once_drawn(_build_asked, max(self._not_before - time.monotonic(), 0.0))
        return self._latest

    def build(self):
        began = time.monotonic()
        for wanted in self._asked:
            self._built[wanted] = self._latest = _build(wanted)
        self._asked.clear()
        for old in list(self._built)[: -self.MOST]:
            del self._built[old]
        took = time.monotonic() - began
        self._not_before = began + took / BUSY_PART
        redraw_views()


_cache = Cache()


def _build_asked():
    _cache.build()


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


def _textures(context, objs, materials, atlases):
    """Of each box."""
    if atlases == "MATERIAL":
        return [texture_of_material(context, name) for name in materials]
    return [find_texture(context, obj, atlases) for obj in (objs if atlases == "OBJECT" else objs[:1])]


def _look(options, textures):
    margin = options.gap_px if options.gap == "PIXELS" else 0.0
    chosen = preferences.get()
    return Look(
        layers=tuple(layer for layer, on in shown.items() if on),
        texture_sizes=tuple(options.texture_pixels(texture) for texture in textures),
        margin_px=margin,
        to_border=options.aspect != "FREE",
        keeps_stacks=options.stacks == "KEEP",
        low=tuple(chosen.heat_low),
        high=tuple(chosen.heat_high),
        worst=chosen.heat_worst,
        opacity=chosen.heat_opacity,
    )


def _batches(context):
    found = [obj for obj in objects.objects_of(context) if not objects.why_not(obj)]
    if not found:
        return {}
    options = to_options(context.scene.atlas_refine)
    names = tuple((obj.name, obj.mode, map_of(obj, options.uv_map)) for obj in found)
    materials = objects.material_names(found) if options.atlases == "MATERIAL" else ()
    look = _look(options, _textures(context, found, materials, options.atlases))
    place = context.scene.name, context.view_layer.name
    return _cache.of(Wanted(*place, names, id(tasks.last), look, materials, options.atlases == "OBJECT"))


def map_of(obj, wanted):
    try:
        return bridge.find_uv_map(obj.data, wanted)
    except bridge.MeshError:
        return ""


def _build(wanted):
    scene = bpy.data.scenes.get(wanted.scene)
    layer = scene and scene.view_layers.get(wanted.view_layer)
    if layer is None:
        return {}
    found = [(bpy.data.objects.get(name), uv_map) for name, _, uv_map in wanted.objects]
    sources = {
        obj.name: _source(obj, uv_map, layer.depsgraph, wanted, number)
        for number, (obj, uv_map) in enumerate(found)
        if obj and obj.type == "MESH"
    }
    sources = {name: source for name, source in sources.items() if source is not None}
    if not sources:
        return {}
    pictures = picture_of(engine.module, list(sources.values()), wanted.look)
    return {name: Batches(picture) for name, picture in zip(sources, pictures, strict=True)}


def _source(obj, uv_map, depsgraph, wanted, number):
    """None for a mesh that cannot be read, of which the operators say why."""
    try:
        with bridge.mesh_to_read(obj) as mesh:
            atlas = bridge.atlas_of(mesh, uv_map)
            triangles = bridge.triangles_of(mesh, atlas)
            boxes = _boxes(obj, mesh, wanted, number)
    except bridge.MeshError:
        return None
    scale, seams = objects.scale_of(obj), tasks.new_seams(obj.name)
    shown, evaluated = bridge.read_shown_positions(obj, depsgraph), None
    mesh = bridge.evaluated_mesh(obj, uv_map, depsgraph)
    if mesh is not None:
        own, shown_atlas = _boxes(obj, mesh, wanted, number), bridge.atlas_of(mesh, uv_map)
        evaluated = Source(shown_atlas, bridge.triangles_of(mesh, shown_atlas), scale, seams[:0], own)
    return Source(atlas, triangles, scale, seams, boxes, shown, evaluated)


def _boxes(obj, mesh, wanted, number):
    """(F,) int."""
    if wanted.materials:
        return objects.materials_of(obj, mesh, {name: k for k, name in enumerate(wanted.materials)})
    return np.full(len(mesh.polygons), wanted.by_object * number)


def _draw_in_uv_editor():
    context = bpy.context
    if context.space_data.mode != "UV":
        return
    gpu.state.blend_set("ALPHA")
    for batches in _batches(context).values():
        _draw_faces(batches, "uv")
        _draw_lines(context, batches, "uv")
    gpu.state.blend_set("NONE")


def _draw_in_3d_view():
    context = bpy.context
    if context.mode not in {"OBJECT", "EDIT_MESH"} or not context.space_data.overlay.show_overlays:
        return
    gpu.state.blend_set("ALPHA")
    gpu.state.depth_test_set("LESS_EQUAL")
    for name, batches in _batches(context).items():
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


def _switch_off():
    for layer in shown:
        shown[layer] = False
    _remove()


_watch = Watch(_switch_off, _cache.outdate, is_needed=lambda: _handles)


def register():
    _watch.register()


def unregister():
    _switch_off()
    no_longer(_build_asked)
    _watch.unregister()
