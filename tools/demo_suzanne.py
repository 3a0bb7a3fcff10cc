"""Runs inside Blender for the demo: an artist's seams, Blender's own unwrap, the operator, and measures."""

import pathlib
import sys
import time

import addon_utils
import atlas_refine
import bpy
import numpy as np

PE_BOUND = 0.80


def make_suzanne():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.mesh.primitive_monkey_add()
    suzanne = bpy.context.object
    mark_seams(suzanne.data)
    subdivision = suzanne.modifiers.new("Subdivision", "SUBSURF")
    subdivision.levels = 2
    bpy.ops.object.modifier_apply(modifier=subdivision.name)
    bpy.ops.object.shade_smooth()
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.uv.unwrap(method="ANGLE_BASED", margin=0.003)
    bpy.ops.object.mode_set(mode="OBJECT")
    return suzanne


def region(face):
    """Ears (front and back), the back of the head, the muzzle, and the two halves of the face."""
    x, y, z = face.center
    if abs(x) > 0.82:
        return "ear", x > 0, face.normal.y > 0
    if y > 0.2:
        return ("back",)
    if y < -0.5 and z < 0.12:
        return ("muzzle",)
    return "face", x > 0


def mark_seams(mesh):
    sides = {}
    for face in mesh.polygons:
        for edge in face.edge_keys:
            sides.setdefault(edge, set()).add(region(face))
    for edge in mesh.edges:
        edge.use_seam = len(sides[edge.key]) > 1


def arrays(mesh):
    """The four array arguments of atlas_refine.measure()."""
    positions = np.array([vertex.co for vertex in mesh.vertices])
    offsets = np.append([face.loop_start for face in mesh.polygons], len(mesh.loops))
    corners = np.array([loop.vertex_index for loop in mesh.loops])
    uvs = np.array([corner.uv for corner in mesh.uv_layers.active.data])
    return positions, offsets, corners, uvs


def export(path):
    """The active object as OBJ, for pictures by the command line program."""
    bpy.ops.wm.obj_export(filepath=str(path), export_selected_objects=True, export_materials=False)


def blenders_packing(mesh):
    """Measures of Blender's own Pack Islands on a copy of the UV map, which is taken away again."""
    layers = mesh.uv_layers
    first = layers.active.name
    layers.active = layers.new(name="packed by Blender")
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.uv.select_all(action="SELECT")
    bpy.ops.uv.pack_islands(rotate=True, margin=0.003)
    bpy.ops.object.mode_set(mode="OBJECT")
    measures = atlas_refine.measure(*arrays(mesh))
    layers.remove(layers.active)
    layers.active = layers[first]
    return measures


def table(mesh, before, packed, after, seconds):
    columns = (before, packed, after)
    rows = [
        ("packing efficiency", *(f"{m.pe:.3f}" for m in columns)),
        ("distortion E_d (1 = isometric)", *(f"{m.distortion:.4f}" for m in columns)),
        ("99th percentile of stretch", *(f"{m.stretch_99:.3f}" for m in columns)),
        ("charts", *(str(m.chart_count) for m in columns)),
        ("seam edges", *(str(m.seam_edges) for m in columns)),
        ("smallest gap, % of diagonal", *(f"{100 * m.gap_between:.3f}" for m in columns)),
    ]
    title = f"Suzanne, {len(mesh.polygons)} faces, Blender {bpy.app.version_string}, bound {PE_BOUND:.2f}, {seconds:.1f} s"
    head = ("", "unwrapped", "Pack Islands", "Atlas Refine")
    lines = [title, "", *(f"{name:32}{a:>14}{b:>14}{c:>14}" for name, a, b, c in (head, *rows))]
    return "\n".join(lines) + "\n"


def main(out):
    suzanne = make_suzanne()
    addon_utils.enable("atlas_refine_addon")
    atlas = arrays(suzanne.data)
    before = atlas_refine.measure(*atlas)
    packed = blenders_packing(suzanne.data)
    export(out / "before.obj")
    began = time.monotonic()
    bpy.ops.uv.atlas_refine(pe_bound=PE_BOUND)
    seconds = time.monotonic() - began
    atlas = arrays(suzanne.data)
    after = atlas_refine.measure(*atlas)
    validity = atlas_refine.validate(*atlas)
    assert validity.valid, validity.problem
    assert after.pe >= PE_BOUND
    export(out / "after.obj")
    (out / "table.txt").write_text(table(suzanne.data, before, packed, after, seconds))
    bpy.ops.wm.save_as_mainfile(filepath=str(out / "suzanne.blend"))


main(pathlib.Path(sys.argv[sys.argv.index("--") + 1]))
