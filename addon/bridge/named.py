# SPDX-License-Identifier: GPL-3.0-or-later
"""What an artist painted or marked: values of faces and edges from vertex groups and attributes of a name, None
where an object has none of that name."""

import bmesh
import numpy as np

from .mesh import MeshError, integers

#: A vertex of weight 1 counts as much more than one without.
MOST_IMPORTANT = 10.0


def face_flags(obj, name, atlas):
    """(F,) bool from a face attribute (not 0) or a vertex group (at least one half at every vertex of the face)."""
    values = _attribute(obj, name, "FACE")
    if values is not None:
        return values != 0
    weights = _weights(obj, name, atlas)
    if weights is None:
        return None
    return np.minimum.reduceat(weights[atlas.corner_vertices], atlas.face_offsets[:-1]) >= 0.5


def importance(obj, name, atlas):
    """(F,) weights from 1 to MOST_IMPORTANT from a vertex group or a face attribute of values from 0 to 1."""
    values = _attribute(obj, name, "FACE")
    if values is None:
        weights = _weights(obj, name, atlas)
        if weights is None:
            return None
        sums = np.add.reduceat(weights[atlas.corner_vertices], atlas.face_offsets[:-1])
        values = sums / np.diff(atlas.face_offsets)
    return 1.0 + (MOST_IMPORTANT - 1.0) * np.clip(values, 0.0, 1.0)


def edges(obj, name):
    """(n, 2) vertices of the edges on which an edge attribute is not 0."""
    values = _attribute(obj, name, "EDGE")
    if values is None:
        return None
    if obj.mode == "EDIT":
        mesh = bmesh.from_edit_mesh(obj.data)
        mesh.verts.index_update()
        ends = np.array([[vert.index for vert in edge.verts] for edge in mesh.edges], dtype=np.int32)
    else:
        ends = integers(obj.data.edges, "vertices", 2)
    return ends.reshape(-1, 2)[values != 0]


def _attribute(obj, name, domain):
    """Its numbers, float64; None where the mesh has no such attribute of numbers."""
    if obj.mode == "EDIT":
        mesh = bmesh.from_edit_mesh(obj.data)
        elements = mesh.faces if domain == "FACE" else mesh.edges
        for kind in ("bool", "int", "float"):
            layers = getattr(elements.layers, kind, None)
            layer = None if layers is None else layers.get(name)
            if layer is not None:
                return np.array([float(element[layer]) for element in elements])
        return _hidden_in_edit_mode(obj, name, domain)
    attribute = obj.data.attributes.get(name)
    if attribute is None or attribute.domain != domain or attribute.data_type not in {"BOOLEAN", "INT", "INT8", "FLOAT"}:
        return None
    return np.array([float(item.value) for item in attribute.data])


def _hidden_in_edit_mode(obj, name, domain):
    """Before 3.6 a BMesh shows no layers of booleans: they are read from a copy in object mode's form."""
    attribute = obj.data.attributes.get(name)
    if attribute is None or attribute.domain != domain or attribute.data_type not in {"BOOLEAN", "INT8"}:
        return None
    raise MeshError(f'this Blender does not show "{name}" in edit mode: leave it, or make it an attribute of integers')


def _weights(obj, name, atlas):
    group = obj.vertex_groups.get(name)
    if group is None:
        return None
    weights = np.zeros(len(atlas.positions))
    if obj.mode == "EDIT":
        mesh = bmesh.from_edit_mesh(obj.data)
        layer = mesh.verts.layers.deform.active
        if layer is not None:
            weights[:] = [vert[layer].get(group.index, 0.0) for vert in mesh.verts]
        return weights
    for vertex in obj.data.vertices:
        for held in vertex.groups:
            if held.group == group.index:
                weights[vertex.index] = held.weight
    return weights
