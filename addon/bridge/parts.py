# SPDX-License-Identifier: GPL-3.0-or-later
"""The objects that an operator works on, and each as a Part of an atlas."""

import bpy
import numpy as np

from ..core.joined import Part
from . import mesh as bridge
from . import named, selection


def objects_of(context):
    """Mesh objects of which each mesh comes once: all in edit mode, else the selected ones, else the active one where it is seen."""
    active = context.active_object
    in_edit_mode = active is not None and active.mode == "EDIT"
    if in_edit_mode:
        found = [obj for obj in context.view_layer.objects if obj.mode == "EDIT"]
    else:
        found = list(context.selected_objects)
        if not found and active is not None and active.visible_get():
            found = [active]
    found = [obj for obj in found if obj.type == "MESH"]
    found.sort(key=lambda obj: obj is not active)
    return list({obj.data: obj for obj in reversed(found)}.values())[::-1]


def why_not(obj):
    """Why an object's UVs cannot be changed, in words that follow its name; empty where they can."""
    mesh = obj.data
    if mesh.library is not None or mesh.override_library is not None:
        return "the mesh is linked from a library and cannot be changed"
    if not mesh.uv_layers:
        return "the mesh has no UV map"
    if obj.mode != "EDIT" and mesh.is_editmode:
        return "another object of the same mesh is in edit mode"
    return ""


def users_of(mesh):
    """How many objects show the mesh."""
    return sum(obj.data is mesh for obj in bpy.data.objects)


def object_of_mesh(name):
    """None where there is none."""
    return next((obj for obj in bpy.data.objects if obj.type == "MESH" and obj.data.name == name), None)


def read_part(context, obj, options, material_numbers):
    """In steps. `material_numbers`: a dict that is shared by the parts of an atlas, and grows."""
    uv_map = bridge.find_uv_map(obj.data, options.uv_map)
    told_by = selection.told_by(context, obj) if obj.mode == "EDIT" else None
    with bridge.mesh_to_read(obj) as mesh:
        yield
        atlas = bridge.atlas_of(mesh, uv_map)
        yield
        triangles = bridge.triangles_of(mesh, atlas)
        yield
        selected = selection.selected_faces(mesh, uv_map, told_by) if obj.mode == "EDIT" else None
        painted = named.Painted(mesh, obj.vertex_groups, atlas)
        return Part(
            name=obj.name,
            uv_map=uv_map,
            atlas=atlas,
            triangles=triangles,
            hidden=selection.hidden_faces(mesh),
            selected=np.ones(len(mesh.polygons), dtype=bool) if selected is None else selected,
            pinned=selection.pinned_faces(mesh, uv_map),
            materials=materials_of(obj, mesh, material_numbers),
            mesh_name=obj.data.name,
            scale=scale_of(obj),
            keep_shape=painted.face_flags(options.keep_shape),
            importance=painted.importance(options.importance),
            no_seam=painted.edges(options.no_seam),
            prefer_seam=painted.edges(options.prefer_seam),
        )


def scale_of(obj):
    """Of the object in the world, the mean of its three; 1 for one that is flat."""
    return float(abs(obj.matrix_world.determinant()) ** (1 / 3)) or 1.0


def material_names(objs):
    """By the numbers that materials_of() gives them: those that tell materials of several libraries apart."""
    return tuple(dict.fromkeys(name for obj in objs for name in _of_slots(obj)))


def _of_slots(obj):
    return [slot.material.name_full if slot.material else "" for slot in obj.material_slots] or [""]


def materials_of(obj, mesh, numbers):
    """(F,) int: the number of each face's material in `numbers`, by names, which grows."""
    of_slots = np.array([numbers.setdefault(name, len(numbers)) for name in _of_slots(obj)])
    indices = bridge.integers(mesh.polygons, "material_index")
    return of_slots[np.clip(indices, 0, len(of_slots) - 1)]
