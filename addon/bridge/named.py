# SPDX-License-Identifier: GPL-3.0-or-later
"""What an artist painted or marked: values of faces and edges from vertex groups and attributes of a name."""

import numpy as np

from .mesh import integers

_NUMBERS = {"BOOLEAN", "INT", "INT8", "FLOAT"}
_DOMAINS = {"POINT": "a point", "EDGE": "an edge", "FACE": "a face", "CORNER": "a face corner"}
#: A vertex of weight 1 counts as much more than one without.
MOST_IMPORTANT = 10.0


def names_of_faces(obj):
    """Vertex groups and face attributes that Painted reads."""
    return [*(group.name for group in obj.vertex_groups), *names_of_edges(obj, "FACE")]


def names_of_edges(obj, domain="EDGE"):
    """Edge attributes that Painted reads; not those that are Blender's own and have no place in its lists."""
    shown = (one for one in obj.data.attributes if not one.name.startswith("."))
    return [one.name for one in shown if one.domain == domain and one.data_type in _NUMBERS]


def why_not_painted(obj, name, domain):
    """Why what the object has of that name is not what Painted reads, vertex groups and numbers of faces, or numbers of edges; empty
    where it has nothing."""
    attribute = obj.data.attributes.get(name)
    if attribute is not None and attribute.domain != domain:
        return f'"{name}" is {_DOMAINS.get(attribute.domain, "another")} attribute'
    if attribute is not None and attribute.data_type not in _NUMBERS:
        return f'the attribute "{name}" does not hold one number for each {domain.lower()}'
    return f'"{name}" is a vertex group' if name in obj.vertex_groups and domain == "EDGE" else ""


class Painted:
    """Of a mesh of mesh_to_read(), in arrays; None where it has nothing of a name, and without a name."""

    def __init__(self, mesh, vertex_groups, atlas):
        self._mesh, self._groups, self._atlas = mesh, vertex_groups, atlas

    def face_flags(self, name):
        """(F,) bool from a face attribute (not 0) or a vertex group (at least one half at every vertex of the face)."""
        values = self._attribute(name, "FACE")
        if values is not None:
            return values != 0
        weights = self._weights(name)
        if weights is None:
            return None
        return np.minimum.reduceat(weights[self._atlas.corner_vertices], self._atlas.face_offsets[:-1]) >= 0.5

    def importance(self, name):
        """(F,) weights from 1 to MOST_IMPORTANT from a vertex group or a face attribute of values from 0 to 1."""
        values = self._attribute(name, "FACE")
        if values is None:
            weights = self._weights(name)
            if weights is None:
                return None
            sums = np.add.reduceat(weights[self._atlas.corner_vertices], self._atlas.face_offsets[:-1])
            values = sums / np.diff(self._atlas.face_offsets)
        return 1.0 + (MOST_IMPORTANT - 1.0) * np.clip(values, 0.0, 1.0)

    def edges(self, name):
        """(n, 2) vertices of the edges on which an edge attribute is not 0."""
        values = self._attribute(name, "EDGE")
        return None if values is None else integers(self._mesh.edges, "vertices", 2).reshape(-1, 2)[values != 0]

    def _attribute(self, name, domain):
        """Its numbers, float64; None where the mesh has no such attribute of numbers."""
        attribute = self._mesh.attributes.get(name) if name else None
        if attribute is None or attribute.domain != domain or attribute.data_type not in _NUMBERS:
            return None
        return np.array([float(item.value) for item in attribute.data])

    def _weights(self, name):
        group = self._groups.get(name) if name else None
        if group is None:
            return None
        weights = np.zeros(len(self._mesh.vertices))
        for vertex in self._mesh.vertices:
            for held in vertex.groups:
                if held.group == group.index:
                    weights[vertex.index] = held.weight
        return weights
