# SPDX-License-Identifier: GPL-3.0-or-later
"""Every difference between the Blender versions that the add-on runs on, told apart by features."""

from contextlib import contextmanager

import bmesh
import bpy
import gpu
import numpy as np


def read_uvs(layer, corner_count):
    """The layer's UVs as (corner_count, 2) float32."""
    uvs = np.empty(2 * corner_count, dtype=np.float32)
    if hasattr(layer, "uv"):  # 3.5 and later
        layer.uv.foreach_get("vector", uvs)
    else:
        layer.data.foreach_get("uv", uvs)
    return uvs.reshape(-1, 2)


def write_uvs(layer, uvs):
    """Stores (C, 2) float32; pins and selection stay."""
    if hasattr(layer, "uv"):  # 3.5 and later
        # Not layer.uv: from 4.2 to 5.0 that writes into arrays that undo steps and copies of the mesh share, and changes them too.
        layer.id_data.attributes[layer.name].data.foreach_set("vector", uvs.ravel())
    else:
        layer.data.foreach_set("uv", uvs.ravel())


#: Of one mesh, in all versions.
MOST_UV_MAPS = 8


def copy_active_uv_map(layers, name):
    """Adds a copy of the active UV map and returns its name, None where there is no room."""
    count = len(layers)
    made = layers.new(name=name, do_init=True)
    if made is not None:
        return made.name
    return layers[-1].name if len(layers) > count else None  # 5.2 says nothing in edit mode, but has made it


def pinned_corners(mesh, uv_map):
    """(C,) bool of a mesh in object mode, None where no corner ever was pinned."""
    # Not the layer's own property: to read it may make the layer of pins.
    return _corner_flags(mesh, uv_map, "pin_uv", (_attribute_name(".pn.", uv_map),))


def selected_corners(mesh, uv_map):
    """The same of what is selected in the UV editor, which has one selection for all maps from 5.0 on."""
    return _corner_flags(mesh, uv_map, "select", (_attribute_name(".vs.", uv_map), ".uv_select_vert"))


def has_synced_uv_selection(mesh):
    """Of a mesh in edit mode: whether its corners are selected by themselves though the UV editor shows the mesh's selection."""
    return getattr(bmesh.from_edit_mesh(mesh), "uv_select_sync_valid", False)  # 5.0 and later


def _attribute_name(prefix, uv_map):
    """As Blender cuts it off."""
    return (prefix + uv_map).encode()[:67].decode(errors="ignore")


def _corner_flags(mesh, uv_map, before_3_5, attributes):
    flags, layer = np.zeros(len(mesh.loops), dtype=bool), mesh.uv_layers[uv_map]
    if not hasattr(layer, "uv"):  # before 3.5
        layer.data.foreach_get(before_3_5, flags)
        return flags
    attribute = next(filter(None, map(mesh.attributes.get, attributes)), None)
    if attribute is None:
        return None
    attribute.data.foreach_get("value", flags)
    return flags


def select_uv(loop, layer, selected):
    if hasattr(loop, "uv_select_vert"):  # 5.0 and later
        loop.uv_select_vert = loop.uv_select_edge = selected
        loop.face.uv_select = selected
        return
    loop[layer].select = selected
    if hasattr(loop[layer], "select_edge"):
        loop[layer].select_edge = selected


def interpolate_corner(loop, face, with_vertex):
    """Gives a BMesh corner, and its vertex where asked for, what the face holds at the vertex's place."""
    try:
        loop.copy_from_face_interp(face, with_vertex, False)
    except TypeError:  # 3.4 wants the three as one argument
        loop.copy_from_face_interp((face, with_vertex, False))


def custom_normals(mesh):
    """(C, 3) float32 corner normals where the mesh has its own ones, else None."""
    if not mesh.has_custom_normals:
        return None
    normals = np.empty(3 * len(mesh.loops), dtype=np.float32)
    if hasattr(mesh, "corner_normals"):  # 4.1 and later
        mesh.corner_normals.foreach_get("vector", normals)
    else:
        with _auto_smooth(mesh):
            mesh.calc_normals_split()
            mesh.loops.foreach_get("normal", normals)
            mesh.free_normals_split()
    return normals.reshape(-1, 3)


def set_custom_normals(mesh, normals):
    """Stores what custom_normals() gave. Edges that are smooth stay smooth."""
    with _auto_smooth(mesh):
        mesh.normals_split_custom_set(normals.tolist())


def copy_auto_smooth(source, target):
    if hasattr(source, "use_auto_smooth"):  # before 4.1
        target.use_auto_smooth = source.use_auto_smooth
        target.auto_smooth_angle = source.auto_smooth_angle


@contextmanager
def _auto_smooth(mesh):
    """Before 4.1 custom normals are there only while this is on."""
    if not hasattr(mesh, "use_auto_smooth"):
        yield
        return
    was_on, mesh.use_auto_smooth = mesh.use_auto_smooth, True
    try:
        yield
    finally:
        mesh.use_auto_smooth = was_on


def progress_bar(layout, fraction, text):
    if hasattr(layout, "progress"):  # 4.0 and later
        layout.progress(factor=fraction, text=text)
    else:
        layout.label(text=f"{text}: {100 * fraction:.0f} %", icon="SORTTIME")


def calc_loop_triangles(mesh):
    """Until 4.0 they are there only once asked for, and then divide quads by the faces' normals where these are known: as what is
    drawn and exported is divided."""
    if hasattr(mesh, "calc_normals"):  # until 4.0
        mesh.calc_normals()
    if hasattr(mesh, "calc_loop_triangles"):
        mesh.calc_loop_triangles()


_commands = {}


def register_command(name, function):
    """`blender --command NAME`: the function gets the arguments and returns the exit code."""
    if hasattr(bpy.utils, "register_cli_command"):  # 4.2 and later
        _commands[name] = bpy.utils.register_cli_command(name, function)


def unregister_command(name):
    if name in _commands:
        bpy.utils.unregister_cli_command(_commands.pop(name))


def shader(name):
    """A built-in shader for points in space, by its name since 4.0."""
    try:
        return gpu.shader.from_builtin(name)
    except ValueError:  # before 4.0
        return gpu.shader.from_builtin(f"3D_{name}")
