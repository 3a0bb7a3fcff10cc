# SPDX-License-Identifier: GPL-3.0-or-later
"""Faces that are hidden, selected and pinned, as the UV editor of this Blender has it."""

import bmesh
import numpy as np

from . import versions


def by_faces(context):
    """Whether selected faces are meant: in the 3D view, and in the UV editor where it shows the mesh's selection."""
    in_3d_view = context.area is not None and context.area.type == "VIEW_3D"
    return in_3d_view or context.scene.tool_settings.use_uv_select_sync


def read_flags(obj, uv_map, face_offsets, faces_count):
    """(hidden, selected, pinned) faces, bool. In object mode all are selected. `faces_count`: by_faces()."""
    if obj.mode == "EDIT":
        return _of_edit_mesh(bmesh.from_edit_mesh(obj.data), uv_map, faces_count)
    mesh = obj.data
    hidden = np.zeros(len(mesh.polygons), dtype=bool)
    mesh.polygons.foreach_get("hide", hidden)
    corners = versions.pinned_corners(mesh, uv_map)
    pinned = np.zeros(len(hidden), dtype=bool) if corners is None else np.logical_or.reduceat(corners, face_offsets[:-1])
    return hidden, np.ones(len(hidden), dtype=bool), pinned


def _of_edit_mesh(mesh, uv_map, faces_count):
    layer = mesh.loops.layers.uv[uv_map]
    rows = []
    for face in mesh.faces:
        selected = face.select and (faces_count or all(versions.is_uv_selected(loop, layer) for loop in face.loops))
        rows.append((face.hide, selected, any(loop[layer].pin_uv for loop in face.loops)))
    return np.array(rows, dtype=bool).reshape(-1, 3).T


def select_faces(obj, uv_map, faces):
    """In edit mode: these faces (indices) and nothing else, in the mesh and in the UV map."""
    mesh = bmesh.from_edit_mesh(obj.data)
    layer = mesh.loops.layers.uv.get(uv_map)
    wanted = set(faces)
    for sequence in (mesh.faces, mesh.edges, mesh.verts):
        for element in sequence:
            element.select_set(False)
    for index, face in enumerate(mesh.faces):
        if index in wanted and not face.hide:
            face.select_set(True)
        for loop in face.loops:
            versions.select_uv(loop, layer, index in wanted)
    mesh.select_flush_mode()
    bmesh.update_edit_mesh(obj.data, loop_triangles=False, destructive=False)
