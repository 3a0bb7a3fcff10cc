# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads an object's mesh and UV map into arrays and writes UVs back, in object mode and in edit mode."""

from contextlib import contextmanager

import bmesh
import bpy
import numpy as np

from ..core.atlas import AtlasArrays
from ..core.borders import are_among
from ..core.steps import at_once
from . import versions

#: That are written in edit mode before the window has its turn.
FACES_OF_A_STEP = 10000


#: Of modifiers: more would make the window wait.
MOST_FACES_DRAWN = 500_000


class MeshError(Exception):
    """The object cannot be used; the message is one line and does not name the object."""


def find_uv_map(mesh, wanted):
    """The name of a UV map: '' is the active one; else a name or, where no map has that name, an index."""
    layers = mesh.uv_layers
    if not layers:
        raise MeshError("the mesh has no UV map")
    if not wanted:
        return layers.active.name
    if wanted in layers:
        return wanted
    if wanted.isdecimal() and int(wanted) < len(layers):
        return layers[int(wanted)].name
    raise MeshError(f'the mesh has no UV map "{wanted}"')


def has_uneven_scale(obj):
    """Whether the object's scale bends the surface in a way that UV tools, which work on the mesh, do not see."""
    scale = np.abs(np.array(obj.scale))
    return scale.max() > scale.min() * 1.001


@contextmanager
def mesh_to_read(obj):
    """The object's mesh with its arrays; edit mode's, pending changes included, as a copy that is gone afterwards: through a BMesh
    Python would read it corner by corner. It makes data, so never while something is drawn."""
    if obj.mode != "EDIT":
        yield obj.data
        return
    copy = bpy.data.meshes.new("Atlas Refine")
    try:
        bmesh.from_edit_mesh(obj.data).to_mesh(copy)
        yield copy
    finally:
        bpy.data.meshes.remove(copy)


def read_atlas(obj, uv_map):
    """The mesh and the named UV map as it is now; edit mode's pending changes included."""
    return at_once(read_in_steps(obj, uv_map))


def read_in_steps(obj, uv_map):
    """The same."""
    with mesh_to_read(obj) as mesh:
        yield
        return atlas_of(mesh, uv_map)


def write_uvs(obj, uv_map, uvs):
    """Stores (C, 2) float32 UVs in the named map and nothing else. Raises MeshError where what is then stored is not what was
    given (object mode): the old ones are to be written again."""
    at_once(write_in_steps(obj, uv_map, uvs))


def write_in_steps(obj, uv_map, uvs):
    """The same. What is half written is not drawn, and nothing may change the mesh meanwhile."""
    mesh = obj.data
    if obj.mode == "EDIT":
        yield from write_edit_mesh(bmesh.from_edit_mesh(mesh), uv_map, uvs)
        bmesh.update_edit_mesh(mesh, loop_triangles=False, destructive=False)
        return  # corner by corner, each by its own name: there is nothing that a copy of the mesh could tell
    versions.write_uvs(mesh.uv_layers[uv_map], uvs)
    mesh.update()
    yield
    if versions.read_uvs(mesh.uv_layers[uv_map], len(mesh.loops)).tobytes() != uvs.tobytes():
        raise MeshError("Blender did not store the new UVs as they were given")


def triangles_of(mesh, atlas):
    """How Blender divides faces of more than three corners: (T, 3) int32 corners; `atlas`: what atlas_of() gave for the mesh."""
    versions.calc_loop_triangles(mesh)
    loops = integers(mesh.loop_triangles, "loops", 3).reshape(-1, 3)
    sizes = np.diff(atlas.face_offsets)
    return loops[np.repeat(sizes > 3, np.maximum(sizes - 2, 0))]  # they come in the order of the faces


def read_shown_positions(obj, depsgraph):
    """(V, 3) float32: where modifiers and shape keys move the vertices; None in edit mode, and where they make other faces."""
    if depsgraph is None or obj.mode == "EDIT" or has_other_faces(obj, depsgraph):
        return None
    shown, mesh = obj.evaluated_get(depsgraph).data, obj.data
    if not np.array_equal(integers(shown.loops, "vertex_index"), integers(mesh.loops, "vertex_index")):
        return None
    return _positions(shown)


def evaluated_mesh(obj, uv_map, depsgraph):
    """What modifiers make of the mesh where they make other faces that have the UV map, in object mode; else None."""
    if depsgraph is None or obj.mode == "EDIT" or not has_other_faces(obj, depsgraph):
        return None
    mesh = obj.evaluated_get(depsgraph).data
    return mesh if uv_map in mesh.uv_layers and 0 < len(mesh.polygons) <= MOST_FACES_DRAWN else None


def has_other_faces(obj, depsgraph):
    """Whether modifiers make more, or fewer, than the mesh has, as far as a look at the numbers tells; object mode."""
    meshes = obj.evaluated_get(depsgraph).data, obj.data
    shown, own = ((len(mesh.vertices), len(mesh.polygons), len(mesh.loops)) for mesh in meshes)
    return shown != own


def check_room_for_copy(obj):
    """Refuses an object whose mesh can have no further UV map."""
    if len(obj.data.uv_layers) >= versions.MOST_UV_MAPS:
        raise MeshError("the mesh has no room for another UV map")


def add_copy(obj, uv_map):
    """Adds a UV map that holds what the named one does, and is active. Returns its name, and that of the one that was active."""
    layers = obj.data.uv_layers
    before = layers.active.name
    layers.active = layers[uv_map]
    name = versions.copy_active_uv_map(layers, f"{uv_map} refined")
    if name is None:
        layers.active = layers[before]
        raise MeshError("the mesh has no room for another UV map")
    layers.active = layers[name]
    return name, before


def remove_copy(obj, copied, before):
    """Takes back what add_copy() did."""
    layers = obj.data.uv_layers
    layers.remove(layers[copied])
    layers.active = layers[before]


def mark_seams(obj, edges):
    """Marks edges, (S, 2) vertices, as seams."""
    if not len(edges):
        return
    mesh = obj.data
    if obj.mode == "EDIT":
        edit = bmesh.from_edit_mesh(mesh)
        edit.verts.ensure_lookup_table()
        for a, b in np.asarray(edges).tolist():
            edge = edit.edges.get((edit.verts[a], edit.verts[b]))
            if edge is not None:
                edge.seam = True
        bmesh.update_edit_mesh(mesh, loop_triangles=False, destructive=False)
        return
    for index in np.flatnonzero(are_among(integers(mesh.edges, "vertices", 2).reshape(-1, 2), edges)).tolist():
        mesh.edges[index].use_seam = True
    mesh.update()


def integers(elements, attribute, each=1):
    """What elements of a mesh, each with so many, hold in an attribute, flat."""
    values = np.empty(each * len(elements), dtype=np.int32)
    elements.foreach_get(attribute, values)
    return values


def atlas_of(mesh, uv_map):
    """A mesh of mesh_to_read()."""
    if uv_map not in mesh.uv_layers:
        raise MeshError(f'the mesh has no UV map "{uv_map}" any more')
    corner_vertices = integers(mesh.loops, "vertex_index")
    starts, sizes = integers(mesh.polygons, "loop_start"), integers(mesh.polygons, "loop_total")
    offsets = np.concatenate([[0], np.cumsum(sizes)]).astype(np.int32)
    if not np.array_equal(offsets[:-1], starts) or offsets[-1] != len(mesh.loops):
        raise MeshError("the corners of the mesh's faces are not in order: run Mesh.validate() on it")
    uvs = versions.read_uvs(mesh.uv_layers[uv_map], len(mesh.loops))
    return AtlasArrays(_positions(mesh), offsets, corner_vertices, uvs)


def _positions(mesh):
    positions = np.empty(3 * len(mesh.vertices), dtype=np.float32)
    mesh.vertices.foreach_get("co", positions)
    return positions.reshape(-1, 3)


def write_edit_mesh(mesh, uv_map, uvs):
    """In steps, of a BMesh; nothing is drawn anew."""
    layer = _edit_layer(mesh, uv_map)
    rows = zip(*uvs.T.tolist(), strict=True)  # one after the other: a list of all would keep Python's garbage collector busy
    for number, face in enumerate(mesh.faces, 1):
        for loop in face.loops:
            loop[layer].uv = next(rows)
        if number % FACES_OF_A_STEP == 0:
            yield


def _edit_layer(mesh, uv_map):
    layer = mesh.loops.layers.uv.get(uv_map)
    if layer is None:
        raise MeshError(f'the mesh has no UV map "{uv_map}" any more')
    return layer
