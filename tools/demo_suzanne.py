"""Runs inside Blender for the demo: an artist's seams, Blender's own unwrap, the operator, measures and drawings."""

import pathlib
import sys
import time

import addon_utils
import atlas_refine
import bpy
import numpy as np

PE_BOUND = 0.80
#: Heat map of stretch max(s1, 1 / s2): from isometric to twice as long or half as wide.
COLOURS = np.array([[0.93, 0.95, 0.97], [0.98, 0.83, 0.45], [0.84, 0.24, 0.16]])


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


def corner_triangles(offsets):
    """Corner indices of each face's fan, and the face of each triangle."""
    sizes = np.diff(offsets)
    faces = np.repeat(np.arange(len(sizes)), sizes - 2)
    steps = np.concatenate([np.arange(1, size - 1) for size in sizes])
    first = offsets[faces]
    return np.column_stack([first, first + steps, first + steps + 1]), faces


def face_stretch(positions, offsets, corners, uvs):
    """Largest max(s1, 1 / s2) of each face's triangles, under the scale that keeps the whole area."""
    triangles, faces = corner_triangles(offsets)
    p, q = positions[corners[triangles]], uvs[triangles]
    a, b = p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]
    length = np.linalg.norm(a, axis=1)
    x = np.einsum("ij,ij->i", a, b) / length
    y = np.linalg.norm(np.cross(a, b), axis=1) / length
    u, v = q[:, 1] - q[:, 0], q[:, 2] - q[:, 0]
    jacobian = np.stack([u / length[:, None], (v - u * (x / length)[:, None]) / y[:, None]], axis=2)
    surface, covered = 0.5 * np.sum(length * y), 0.5 * np.sum(u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0])
    singular = np.linalg.svd(jacobian * np.sqrt(surface / covered), compute_uv=False)
    stretch = np.zeros(len(offsets) - 1)
    np.maximum.at(stretch, faces, np.maximum(singular[:, 0], 1 / singular[:, 1]))
    return stretch


def draw(path, atlas, caption):
    """The UV layout in its box, each face in the colour of its stretch."""
    offsets, uvs = atlas[1], atlas[3]
    heat = np.clip(face_stretch(*atlas) - 1, 0, 1) * 2
    low = np.minimum(heat.astype(int), 1)
    colours = COLOURS[low] + (COLOURS[low + 1] - COLOURS[low]) * (heat - low)[:, None]
    lower = uvs.min(axis=0)
    size = uvs.max(axis=0) - lower
    scale = 1000 / size.max()
    width, height = size * scale
    points = (uvs - lower) * scale * [1, -1] + [0, height]
    lines = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="-20 -60 {width + 40:.1f} {height + 80:.1f}" font-family="sans-serif">',
        f'<rect x="-20" y="-60" width="{width + 40:.1f}" height="{height + 80:.1f}" fill="white"/>',
        f'<text x="0" y="-22" font-size="26">{caption}</text>',
        f'<rect width="{width:.1f}" height="{height:.1f}" fill="#e4e4e4" stroke="#555" stroke-width="1.5"/>',
    ]
    for begin, end, colour in zip(offsets[:-1], offsets[1:], colours, strict=True):
        outline = " ".join(f"{x:.2f},{y:.2f}" for x, y in points[begin:end])
        red, green, blue = (255 * colour).astype(int)
        lines.append(f'<polygon points="{outline}" fill="rgb({red},{green},{blue})" stroke="#345" stroke-width="0.4"/>')
    path.write_text("\n".join([*lines, "</svg>\n"]))


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
    draw(out / "before.svg", atlas, f"Blender's unwrap: PE {before.pe:.3f}, E_d {before.distortion:.4f}")
    began = time.monotonic()
    bpy.ops.uv.atlas_refine(pe_bound=PE_BOUND)
    seconds = time.monotonic() - began
    atlas = arrays(suzanne.data)
    after = atlas_refine.measure(*atlas)
    validity = atlas_refine.validate(*atlas)
    assert validity.valid, validity.problem
    assert after.pe >= PE_BOUND
    draw(out / "after.svg", atlas, f"Atlas Refine: PE {after.pe:.3f}, E_d {after.distortion:.4f}, no seam added")
    (out / "table.txt").write_text(table(suzanne.data, before, after, seconds))
    bpy.ops.wm.save_as_mainfile(filepath=str(out / "suzanne.blend"))


main(pathlib.Path(sys.argv[sys.argv.index("--") + 1]))
