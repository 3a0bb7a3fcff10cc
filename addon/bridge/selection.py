# SPDX-License-Identifier: GPL-3.0-or-later
"""Faces that are hidden, selected and pinned, as the UV editor of this Blender has it."""

import bmesh
import numpy as np

from . import versions
from .mesh import FACES_OF_A_STEP, integers

#: What tells which faces of a mesh in edit mode are selected: the mesh in the 3D view, and in the UV editor where it shows the mesh's
#: selection; else corners of faces that the UV editor shows; or corners alone, where it shows the mesh's selection and yet parts
#: faces that meet at a seam.
MESH, SHOWN_CORNERS, CORNERS = range(3)


def told_by(context, obj):
    """One of the three above."""
    if context.area is not None and context.area.type == "VIEW_3D":
        return MESH
    if not context.scene.tool_settings.use_uv_select_sync:
        return SHOWN_CORNERS
    return CORNERS if versions.has_synced_uv_selection(obj.data) else MESH


def hidden_faces(mesh):
    """(F,) bool, here and below, of a mesh of mesh_to_read()."""
    return _flags(mesh.polygons, "hide")


def selected_faces(mesh, uv_map, told_by):
    """Where corners tell, all of a face have to be selected."""
    faces = _flags(mesh.polygons, "select")
    if told_by == MESH:
        return faces
    corners = _reduced(np.logical_and, mesh, versions.selected_corners(mesh, uv_map))
    return corners if told_by == CORNERS else faces & corners


def pinned_faces(mesh, uv_map):
    """Those with a pinned corner."""
    return _reduced(np.logical_or, mesh, versions.pinned_corners(mesh, uv_map))


def _flags(elements, attribute):
    flags = np.zeros(len(elements), dtype=bool)
    elements.foreach_get(attribute, flags)
    return flags


def _reduced(function, mesh, corners):
    """Of each face's corners; none where there is nothing about corners."""
    if corners is None or not len(mesh.polygons):
        return np.zeros(len(mesh.polygons), dtype=bool)
    return function.reduceat(corners, integers(mesh.polygons, "loop_start"))


def select_in_steps(obj, uv_map, wanted):
    """In edit mode: these faces (a set of indices) and nothing else, in the mesh and in the UV map."""
    mesh = bmesh.from_edit_mesh(obj.data)
    layer = mesh.loops.layers.uv.get(uv_map)
    for sequence in (mesh.faces, mesh.edges, mesh.verts):
        for number, element in enumerate(sequence, 1):
            element.select_set(False)
            if number % FACES_OF_A_STEP == 0:
                yield
    for index, face in enumerate(mesh.faces):
        chosen = index in wanted and not face.hide
        if chosen:
            face.select_set(True)
        for loop in face.loops:
            versions.select_uv(loop, layer, chosen)
        if index % FACES_OF_A_STEP == 0:
            yield
    mesh.select_flush_mode()
    bmesh.update_edit_mesh(obj.data, loop_triangles=False, destructive=False)
