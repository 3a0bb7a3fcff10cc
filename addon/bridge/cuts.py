# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes a cut mesh into an object's mesh, in object mode and in edit mode: all of it, or nothing."""

import bmesh
import bpy

from ..core.cuts import same_faces
from ..core.steps import at_once
from . import versions
from .divide import divide_in_steps
from .mesh import MeshError, atlas_of, mesh_to_read, write_edit_mesh


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
    division = at_once(rehearse_cut(obj, uv_map, plan, mark_seams))
    at_once(write_before_division(obj, uv_map, plan))
    for function in division:
        function()


def rehearse_cut(obj, uv_map, plan, mark_seams=True):
    """In steps: all of write_cut() that may fail, on a copy. Returns the functions that, one after the other, divide the mesh's
    faces, after write_before_division(). Between them the mesh is as before, or whole."""
    if obj.mode == "EDIT":
        return (yield from _rehearse_in_edit_mode(obj, uv_map, plan, mark_seams))
    return (yield from _rehearse_in_object_mode(obj.data, uv_map, plan, mark_seams))


def write_before_division(obj, uv_map, plan):
    """In steps: in edit mode, where each corner is written by itself, the UVs that take long. Other UVs undo it, until the faces
    are divided; what is half written is not drawn."""
    if obj.mode == "EDIT":
        uvs = yield plan.uvs_before_division
        yield from write_edit_mesh(bmesh.from_edit_mesh(obj.data), uv_map, uvs)


def _rehearse_in_object_mode(mesh, uv_map, plan, mark_seams):
    normals = versions.custom_normals(mesh)
    built = bmesh.new()
    try:
        built.from_mesh(mesh)
        yield
        yield from divide_in_steps(built, uv_map, plan, mark_seams)
        order = yield from _check(built, uv_map, plan)
        if normals is not None:
            normals = yield lambda: plan.directions(normals)[order]
        uvs = plan.atlas.corner_uvs[order]
    except BaseException:
        built.free()
        raise

    def write():
        built.to_mesh(mesh)
        built.free()
        versions.write_uvs(mesh.uv_layers[uv_map], uvs)
        if normals is not None:
            versions.set_custom_normals(mesh, normals)
        mesh.update()

    return [write]


def _rehearse_in_edit_mode(obj, uv_map, plan, mark_seams):
    """The edit mesh itself is divided, so that selection and edit mode's memory of shape keys stay; custom normals can only be
    written in object mode."""
    rehearsal = bmesh.new()
    try:
        with mesh_to_read(obj) as flat:  # BMesh's own copy() takes as long as both, at once
            versions.copy_auto_smooth(obj.data, flat)
            normals = versions.custom_normals(flat)
            yield
            rehearsal.from_mesh(flat)
        yield
        yield from divide_in_steps(rehearsal, uv_map, plan, mark_seams)
        order = yield from _check(rehearsal, uv_map, plan)
    finally:
        rehearsal.free()
    if normals is not None:
        normals = yield lambda: plan.directions(normals)[order]
    return _division_in_edit_mode(obj, uv_map, plan, mark_seams, normals)


def _division_in_edit_mode(obj, uv_map, plan, mark_seams, normals):
    live = steps = None

    def prepare():
        nonlocal live, steps
        live = bmesh.from_edit_mesh(obj.data)  # another object's write() may have left edit mode meanwhile
        steps = divide_in_steps(live, uv_map, plan, mark_seams)
        next(steps)

    def write():
        for _ in steps:
            pass
        live.normal_update()
        bmesh.update_edit_mesh(obj.data, loop_triangles=True, destructive=True)
        if normals is not None:
            bpy.ops.object.mode_set(mode="OBJECT")
            versions.set_custom_normals(obj.data, normals)
            bpy.ops.object.mode_set(mode="EDIT")

    return [prepare, write]


def _atlas_of_bmesh(built, uv_map):
    flat = bpy.data.meshes.new("Atlas Refine")
    try:
        built.to_mesh(flat)
        return atlas_of(flat, uv_map)
    finally:
        bpy.data.meshes.remove(flat)


def _check(built, uv_map, plan):
    """In steps: the plan's corner for each corner of the BMesh, which must hold what was planned to the last bit, and in faces that
    are changed the UVs, too."""
    yield
    stored = _atlas_of_bmesh(built, uv_map)
    corners = yield lambda: same_faces(stored, plan.atlas)
    if (
        corners is None
        or stored.positions.tobytes() != plan.atlas.positions.tobytes()
        or not plan.holds_changed(stored.corner_uvs, corners)
    ):
        raise MeshError("Blender did not build the cut mesh as it was given")
    return corners
