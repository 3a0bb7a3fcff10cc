"""UVs that are equal to Blender are equal here: no edge is torn that was not, as Blender's own rule has it."""

import itertools
import math
import sys
import unittest

import bmesh
import bpy
import numpy as np
from support import MODULE, add_mesh, fresh_scene, get_uvs, messages, only_uvs_change, set_uvs, texture_share

#: Corners at one vertex are connected in the UV editor where neither coordinate differs by more (STD_UV_CONNECT_LIMIT).
CONNECTED = 1e-4
NOISE = 3e-7


def torn_edges(mesh, winding_counts=True):
    """The edges of two faces that are no neighbours in the UV editor: their UVs at it differ by more than Blender's threshold, or they
    are wound in opposite senses there, where Blender's islands end, unless that is not to count."""
    uvs = get_uvs(mesh.uv_layers.active)
    sides, winding = {}, {}
    for polygon in mesh.polygons:
        loops = list(polygon.loop_indices)
        u, v = uvs[loops].astype(np.float64).T
        positive = np.sum(u * np.roll(v, -1) - np.roll(u, -1) * v) > 0
        for a, b in zip(loops, loops[1:] + loops[:1], strict=True):
            ends = sorted((mesh.loops[loop].vertex_index, loop) for loop in (a, b))
            sides.setdefault((ends[0][0], ends[1][0]), []).append([uvs[loop] for _, loop in ends])
            winding.setdefault((ends[0][0], ends[1][0]), set()).add(positive)
    return {
        key
        for key, both in sides.items()
        if len(both) == 2 and (np.abs(np.subtract(*both)).max() > CONNECTED or (winding_counts and len(winding[key]) == 2))
    }


def add_noise(obj, size):
    layer = obj.data.uv_layers.active
    uvs = get_uvs(layer)
    set_uvs(layer, uvs + np.random.default_rng(5).uniform(-size, size, uvs.shape).astype(np.float32))


def unwrap(obj, **smart):
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.uv.smart_project(**smart)
    bpy.ops.object.mode_set(mode="OBJECT")


def bevelled_cube():
    """With the UVs that the bevel leaves: near each other, and not equal."""
    bpy.ops.mesh.primitive_cube_add()
    obj = bpy.context.object
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.mesh.bevel(offset=0.2, segments=3)
    bpy.ops.object.mode_set(mode="OBJECT")
    return obj


def grid():
    bpy.ops.mesh.primitive_grid_add(x_subdivisions=12, y_subdivisions=7)
    return bpy.context.object


def smart_cube():
    obj = bevelled_cube()
    unwrap(obj, angle_limit=math.radians(66))
    return obj


def half_then_mirrored():
    """Half a sphere unwrapped and mirrored, the modifier applied: charts at its middle line are folded there."""
    bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=3)
    obj = bpy.context.object
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.mesh.bisect(plane_co=(0, 0, 0), plane_no=(1, 0, 0), clear_inner=True)
    bpy.ops.object.mode_set(mode="OBJECT")
    unwrap(obj, angle_limit=math.radians(66))
    obj.modifiers.new("Mirror", "MIRROR")
    bpy.ops.object.modifier_apply(modifier="Mirror")
    return obj


def halves(mesh):
    """Of the faces of either half of a mirrored mesh the UVs, sorted, since one half runs the other way round."""
    uvs = get_uvs(mesh.uv_layers.active)
    faces = [sorted(map(tuple, uvs[list(polygon.loop_indices)].tolist())) for polygon in mesh.polygons]
    return faces[: len(faces) // 2], faces[len(faces) // 2 :]


def bevel_without_width():
    """Faces between one row and the next that have no width, and end within the chart: beyond them the rows meet."""
    columns, thin, heights = 6, 3, (0.0, 0.1, 0.1, 0.2)
    positions = np.array([(0.1 * i, y, 0.0) for y in heights for i in range(columns + 1)])
    vertex = [[row * (columns + 1) + i for i in range(columns + 1)] for row in range(4)]
    quads = [
        (low[i], low[i + 1], high[i + 1], high[i])
        for row, (low, high) in enumerate(itertools.pairwise(vertex))
        for i in range(columns if row != 1 else thin)
    ]
    corners = np.array(quads).ravel()
    return add_mesh((positions, np.arange(0, len(corners) + 1, 4), corners, positions[corners, :2]), name="Bevel")


class EqualUvs(unittest.TestCase):
    def setUp(self):
        fresh_scene()

    def check(self, make, noise=0.0, **options):
        obj = make()
        if noise:
            add_noise(obj, noise)
        before = torn_edges(obj.data)
        with only_uvs_change(obj):
            told = messages(bpy.ops.uv.atlas_refine, **options)
        self.assertIn("no new seams", told)
        self.assertEqual(torn_edges(obj.data) - before, set())
        return obj, before

    def test_a_bevelled_cube_as_it_comes(self):
        self.check(bevelled_cube, pe_bound=0.6, best_effort=True)

    def test_a_bevelled_cube_unwrapped(self):
        obj, _ = self.check(smart_cube)
        self.assertGreaterEqual(texture_share(obj), 0.8)

    def test_a_grid(self):
        obj, before = self.check(grid)
        self.assertEqual(before, set())
        self.assertGreaterEqual(texture_share(obj), 0.8)

    def test_faces_without_width_do_not_cost_their_chart(self):
        obj, _ = self.check(bevel_without_width, pe_bound=0.7)
        (done,) = sys.modules[f"{MODULE}.tasks"].last
        self.assertEqual([chart.fate for chart in done.result.charts], ["refined"])
        self.assertGreaterEqual(texture_share(obj), 0.7)

    def test_noise(self):
        for make in (grid, smart_cube, bevelled_cube):
            fresh_scene()
            self.check(make, noise=NOISE, pe_bound=0.7, best_effort=True)

    def test_faces_wound_the_other_way_stay_one_chart(self):
        obj = grid()
        mesh = bmesh.new()
        mesh.from_mesh(obj.data)
        bmesh.ops.reverse_faces(mesh, faces=[face for face in mesh.faces if face.index % 5 == 0])
        mesh.to_mesh(obj.data)
        mesh.free()
        self.assertEqual(torn_edges(obj.data, winding_counts=False), set())
        with only_uvs_change(obj):
            self.assertIn("no new seams", messages(bpy.ops.uv.atlas_refine, pe_bound=0.7))
        self.assertEqual(torn_edges(obj.data, winding_counts=False), set())

    def test_mirrored_halves_stay_on_each_other_and_joined(self):
        obj = half_then_mirrored()
        torn = torn_edges(obj.data, winding_counts=False)
        self.assertEqual(*halves(obj.data))
        folded = torn_edges(obj.data) - torn
        self.assertGreater(len(folded), 10)
        with only_uvs_change(obj):
            told = messages(bpy.ops.uv.atlas_refine)
        self.assertIn("no new seams", told)
        self.assertNotIn("parted", told)
        self.assertEqual(torn_edges(obj.data, winding_counts=False), torn)
        self.assertEqual(*halves(obj.data))

    def test_mirrored_halves_are_parted_on_request(self):
        obj = half_then_mirrored()
        with only_uvs_change(obj):
            told = messages(bpy.ops.uv.atlas_refine, stacks="SEPARATE", mark_seams=False)
        self.assertIn("parted", told)
        self.assertGreaterEqual(texture_share(obj), 0.8)

    def test_edges_that_halves_are_parted_along_become_seams(self):
        obj = half_then_mirrored()
        before = {edge.key for edge in obj.data.edges if edge.use_seam}
        bpy.ops.uv.atlas_refine(stacks="SEPARATE")
        self.assertGreater({edge.key for edge in obj.data.edges if edge.use_seam}, before)
