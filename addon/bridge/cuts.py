# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes a cut mesh into an object's mesh, in object mode and in edit mode: all of it, or nothing."""

import bmesh
import bpy

from ..core.cuts import same_faces
from . import versions
from .divide import divide
from .mesh import MeshError, atlas_of


def check_divisible(obj):
    """Refuses an object whose faces cannot be divided without harm."""
    if obj.mode not in {"OBJECT", "EDIT"}:
        raise MeshError("seams that cut faces need object mode or edit mode")
    if obj.mode == "OBJECT" and obj.data.is_editmode:
        raise MeshError("another object of the same mesh is in edit mode")
    for user in bpy.data.objects:
        if user.data is obj.data and any(modifier.type == "MULTIRES" for modifier in user.modifiers):
            raise MeshError(f"seams that cut faces would spoil the Multiresolution levels of {user.name}: apply them first")


def write_cut(obj, uv_map, plan, mark_seams=True):
    """Makes the object's mesh the plan's. Raises with the mesh as it was."""
    rehearse_cut(obj, uv_map, plan, mark_seams)()


def rehearse_cut(obj, uv_map, plan, mark_seams=True):
    """Does to a copy all of write_cut() that may fail. Returns the function that does the rest."""
    if obj.mode == "EDIT":
        return _rehearse_in_edit_mode(obj, uv_map, plan, mark_seams)
    return _rehearse_in_object_mode(obj.data, uv_map, plan, mark_seams)


def _rehearse_in_object_mode(mesh, uv_map, plan, mark_seams):
    normals = versions.custom_normals(mesh)
    built = bmesh.new()
    try:
        built.from_mesh(mesh)
        divide(built, uv_map, plan, mark_seams)
        order = _check(built, uv_map, plan)
    except Exception:
        built.free()
        raise

    def write():
        built.to_mesh(mesh)
        built.free()
        if normals is not None:
            versions.set_custom_normals(mesh, plan.directions(normals)[order])
        mesh.update()

    return write


def _rehearse_in_edit_mode(obj, uv_map, plan, mark_seams):
    """The edit mesh itself is divided, so that selection and edit mode's memory of shape keys stay; custom normals can only be
    written in object mode."""
    live = bmesh.from_edit_mesh(obj.data)
    normals = _custom_normals_in_edit_mode(live, obj.data)
    rehearsal = live.copy()
    try:
        divide(rehearsal, uv_map, plan, mark_seams)
        order = _check(rehearsal, uv_map, plan)
    finally:
        rehearsal.free()

    def write():
        live = bmesh.from_edit_mesh(obj.data)  # another object's write() may have left edit mode meanwhile
        divide(live, uv_map, plan, mark_seams)
        live.normal_update()
        bmesh.update_edit_mesh(obj.data, loop_triangles=True, destructive=True)
        if normals is not None:
            bpy.ops.object.mode_set(mode="OBJECT")
            versions.set_custom_normals(obj.data, plan.directions(normals)[order])
            bpy.ops.object.mode_set(mode="EDIT")

    return write


def _custom_normals_in_edit_mode(live, mesh):
    flushed = bpy.data.meshes.new("Atlas Refine")
    try:
        live.to_mesh(flushed)
        versions.copy_auto_smooth(mesh, flushed)
        return versions.custom_normals(flushed)
    finally:
        bpy.data.meshes.remove(flushed)


def _atlas_of_bmesh(built, uv_map):
    flat = bpy.data.meshes.new("Atlas Refine")
    try:
        built.to_mesh(flat)
        return atlas_of(flat, uv_map)
    finally:
        bpy.data.meshes.remove(flat)


def _check(built, uv_map, plan):
    """The plan's corner for each corner of the BMesh, which must hold what was planned to the last bit."""
    stored = _atlas_of_bmesh(built, uv_map)
    corners = same_faces(stored, plan.atlas)
    if (
        corners is None
        or stored.positions.tobytes() != plan.atlas.positions.tobytes()
        or stored.corner_uvs.tobytes() != plan.atlas.corner_uvs[corners].tobytes()
    ):
        raise MeshError("Blender did not build the cut mesh as it was given")
    return corners
