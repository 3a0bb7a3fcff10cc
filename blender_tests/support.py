"""What the tests inside Blender share: the add-on, generated meshes, and a snapshot of everything a mesh holds."""

import contextlib
import ctypes
import itertools
import os
import sys
import tempfile

import addon_utils
import bpy
import numpy as np
import shapes  # tests/python

LEGACY = bpy.app.version < (4, 2, 0)
MODULE = "atlas_refine_addon" if LEGACY else "bl_ext.user_default.atlas_refine"
HAS_UV_ATTRIBUTE = bpy.app.version >= (3, 5, 0)


def enable_addon():
    assert addon_utils.enable(MODULE, default_set=True) is not None, f"{MODULE} does not load"


def fresh_scene():
    """An empty scene with the add-on enabled; in edit mode the selected faces count."""
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    bpy.context.scene.tool_settings.use_uv_select_sync = True
    enable_addon()


def add_mesh(arrays=None, name="Loose", uv_map="UVMap"):
    """A new active object from shapes' arrays, three loose charts where none are given."""
    positions, face_offsets, corner_vertices, corner_uvs = shapes.loose() if arrays is None else arrays
    mesh = bpy.data.meshes.new(name)
    faces = [corner_vertices[b:e].tolist() for b, e in itertools.pairwise(face_offsets)]
    mesh.from_pydata(positions.tolist(), [], faces)
    layer = mesh.uv_layers.new(name=uv_map)
    set_uvs(layer, corner_uvs)
    obj = bpy.data.objects.new(name, mesh)
    bpy.context.collection.objects.link(obj)
    for other in bpy.context.view_layer.objects:
        other.select_set(False)
    obj.select_set(True)
    bpy.context.view_layer.objects.active = obj
    return obj


def set_uvs(layer, uvs):
    flat = np.asarray(uvs, dtype=np.float32).ravel()
    if HAS_UV_ATTRIBUTE:
        layer.id_data.attributes[layer.name].data.foreach_set("vector", flat)  # layer.uv may be shared with copies
    else:
        layer.data.foreach_set("uv", flat)


def get_uvs(layer):
    flat = np.empty(2 * len(layer.data), dtype=np.float32)
    if HAS_UV_ATTRIBUTE:
        layer.uv.foreach_get("vector", flat)
    else:
        layer.data.foreach_get("uv", flat)
    return flat.reshape(-1, 2)


def packing_efficiency(mesh, layer):
    """From the stored float32 values, in double precision: shoelace areas over the bounding box. All faces must be positive."""
    uvs = get_uvs(layer).astype(np.float64)
    area = 0.0
    for polygon in mesh.polygons:
        u, v = uvs[list(polygon.loop_indices)].T
        face_area = 0.5 * np.sum(u * np.roll(v, -1) - np.roll(u, -1) * v)
        assert face_area > 0, f"face {polygon.index} is flipped"
        area += face_area
    return area / np.prod(uvs.max(axis=0) - uvs.min(axis=0))


def _column(collection, attribute, dtype, width=1):
    values = np.empty(width * len(collection), dtype=dtype)
    collection.foreach_get(attribute, values)
    return values.tobytes()


def _uv_flags(layer):
    return [[getattr(item, flag) for item in layer.data] for flag in ("pin_uv", "select", "select_edge") if _has(layer, flag)]


def _has(layer, flag):
    return len(layer.data) > 0 and hasattr(layer.data[0], flag)


def _corner_normals(mesh):
    if hasattr(mesh, "corner_normals"):  # 4.1 and later
        return _column(mesh.corner_normals, "vector", np.float32, 3)
    mesh.calc_normals_split()
    return _column(mesh.loops, "normal", np.float32, 3)


#: Of an attribute's type: the property that holds its values, their type, how many there are of each element.
_VALUES = {
    "FLOAT": ("value", np.float32, 1),
    "INT": ("value", np.int32, 1),
    "BOOLEAN": ("value", bool, 1),
    "FLOAT2": ("vector", np.float32, 2),
    "FLOAT_VECTOR": ("vector", np.float32, 3),
    "FLOAT_COLOR": ("color", np.float32, 4),
    "BYTE_COLOR": ("color", np.float32, 4),
}


def _attributes(mesh):
    """All but Blender's own and UV maps, which are told by themselves."""
    return {
        f"attribute {attribute.name}": (attribute.domain, _column(attribute.data, *_VALUES[attribute.data_type]))
        for attribute in mesh.attributes
        if attribute.data_type in _VALUES and attribute.name not in mesh.uv_layers and not attribute.name.startswith(".")
    }


def snapshot(obj, but_uvs_of=None):
    """Everything that the object and its mesh hold, as a dict of bytes and lists; object mode. The UVs of one map left out."""
    mesh = obj.data
    held = {
        "positions": _column(mesh.vertices, "co", np.float32, 3),
        "vertex selection": _column(mesh.vertices, "select", bool),
        "edges": _column(mesh.edges, "vertices", np.int32, 2),
        "seams": _column(mesh.edges, "use_seam", bool),
        "sharp edges": _column(mesh.edges, "use_edge_sharp", bool),
        "face starts": _column(mesh.polygons, "loop_start", np.int32),
        "face sizes": _column(mesh.polygons, "loop_total", np.int32),
        "face materials": _column(mesh.polygons, "material_index", np.int32),
        "smooth faces": _column(mesh.polygons, "use_smooth", bool),
        "face selection": _column(mesh.polygons, "select", bool),
        "hidden faces": _column(mesh.polygons, "hide", bool),
        "corner vertices": _column(mesh.loops, "vertex_index", np.int32),
        "corner edges": _column(mesh.loops, "edge_index", np.int32),
        "corner normals": _corner_normals(mesh),
        "materials": [material and material.name for material in mesh.materials],
        "vertex groups": [group.name for group in obj.vertex_groups],
        "weights": [[(g.group, g.weight) for g in vertex.groups] for vertex in mesh.vertices],
        "uv maps": [layer.name for layer in mesh.uv_layers],
        "active uv map": mesh.uv_layers.active_index,
        "render uv map": [layer.active_render for layer in mesh.uv_layers],
        "matrix": [value for row in obj.matrix_basis for value in row],
        "modifiers": [modifier.name for modifier in obj.modifiers],
        "mode": obj.mode,
        "custom properties": dict(mesh.items()),
    }
    for layer in mesh.uv_layers:
        held[f"flags of {layer.name}"] = _uv_flags(layer)
        if layer.name != but_uvs_of:
            held[f"uvs of {layer.name}"] = get_uvs(layer).tobytes()
    for colour in mesh.color_attributes:
        held[f"colour {colour.name}"] = _column(colour.data, "color", np.float32, 4)
    held |= _attributes(mesh)
    if mesh.shape_keys:
        for key in mesh.shape_keys.key_blocks:
            held[f"shape key {key.name}"] = (_column(key.data, "co", np.float32, 3), key.value)
    return held


def changes(before, after):
    """Names of what two snapshots hold differently."""
    return sorted(name for name in set(before) | set(after) if before.get(name) != after.get(name))


@contextlib.contextmanager
def only_uvs_change(*objs):
    """In object mode and in edit mode: of all that the objects hold, only UVs of their active maps may differ afterwards."""

    def held():
        mode = bpy.context.mode
        if mode == "EDIT_MESH":
            bpy.ops.object.mode_set(mode="OBJECT")
        snapshots = [snapshot(obj, but_uvs_of=obj.data.uv_layers.active.name) for obj in objs]
        if mode == "EDIT_MESH":
            bpy.ops.object.mode_set(mode="EDIT")
        return snapshots

    before = held()
    yield
    for obj, then, now in zip(objs, before, held(), strict=True):
        assert not changes(then, now), (obj.name, changes(then, now))


def texture_share(*objs):
    """Of the texture's square, from the stored values, where all of them lie in it."""
    share = 0.0
    for obj in objs:
        layer = obj.data.uv_layers.active
        uvs = get_uvs(layer).astype(np.float64)
        assert np.all((uvs >= 0) & (uvs <= 1)), (uvs.min(), uvs.max())
        share += packing_efficiency(obj.data, layer) * np.prod(uvs.max(axis=0) - uvs.min(axis=0))
    return share


def messages(operator, **options):
    """What an operator reports, as Blender writes it to the console; errors too."""
    sys.stdout.flush()
    kept = os.dup(1)
    with tempfile.TemporaryFile() as held:
        os.dup2(held.fileno(), 1)
        try:
            operator(**options)
        except RuntimeError as error:
            print(error, flush=True)
        finally:
            sys.stdout.flush()  # Blender writes reports to it
            ctypes.CDLL(None).fflush(None)
            os.dup2(kept, 1)
            os.close(kept)
        held.seek(0)
        return held.read().decode()
