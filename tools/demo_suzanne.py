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


def table(mesh, before, after, seconds):
    rows = [
        ("packing efficiency", f"{before.pe:.3f}", f"{after.pe:.3f}"),
        ("distortion E_d (1 = isometric)", f"{before.distortion:.4f}", f"{after.distortion:.4f}"),
        ("99th percentile of stretch", f"{before.stretch_99:.3f}", f"{after.stretch_99:.3f}"),
        ("charts", str(before.chart_count), str(after.chart_count)),
        ("seam edges", str(before.seam_edges), str(after.seam_edges)),
        ("smallest gap, % of diagonal", f"{100 * before.gap_between:.3f}", f"{100 * after.gap_between:.3f}"),
    ]
    title = f"Suzanne, {len(mesh.polygons)} faces, Blender {bpy.app.version_string}, bound {PE_BOUND:.2f}, {seconds:.1f} s"
    lines = [title, "", f"{'':32}{'before':>10}{'after':>10}", *(f"{name:32}{a:>10}{b:>10}" for name, a, b in rows)]
    return "\n".join(lines) + "\n"


def main(out):
    suzanne = make_suzanne()
    addon_utils.enable("atlas_refine_addon")
    atlas = arrays(suzanne.data)
    before = atlas_refine.measure(*atlas)
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
    (out / "table.txt").write_text(table(suzanne.data, before, after, seconds))
    bpy.ops.wm.save_as_mainfile(filepath=str(out / "suzanne.blend"))


main(pathlib.Path(sys.argv[sys.argv.index("--") + 1]))
