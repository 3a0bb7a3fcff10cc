"""A cut mesh written into Blender's: everything that vertices, edges, faces and corners carry follows. The cuts are made by hand."""

import dataclasses
import itertools
import unittest

import bmesh
import bpy
import numpy as np
import shapes
from cuts import Cutter
from rich_mesh import add_rich_mesh, bridge, core, data_of, edge_data, normals, select_and_hide, shape
from support import add_mesh, changes, fresh_scene, get_uvs, set_uvs, snapshot

LINES = ((0, 1.27, range(8)), (1, 0.43, None), (1, 1.59, [4, 5], 1.27))  # the last one ends in a T-joint inside of face 5

MANY_LINES = [(0, 0.37 * k) for k in range(1, 11)] + [(1, 0.29 * k) for k in range(1, 11)]


def make_cut(obj, lines):
    """(cut, UVs) along these lines."""
    cutter = Cutter(*bridge("mesh").read_atlas(obj, "UVMap").as_tuple())
    for line in lines:
        cutter.cut(*line)
    return cutter.result(shift=0.05)


def make_plan(obj, lines=LINES):
    return core("cuts").plan_cut(bridge("mesh").read_atlas(obj, "UVMap"), *make_cut(obj, lines))


class Cuts(unittest.TestCase):
    def setUp(self):
        fresh_scene()

    def cut(self, obj, mode="OBJECT", lines=LINES):
        if mode == "EDIT":
            bpy.ops.object.mode_set(mode="EDIT")
        plan = make_plan(obj, lines)
        bridge("cuts").write_cut(obj, "UVMap", plan)
        self.assertEqual(obj.mode, mode)
        if mode == "EDIT":
            bpy.ops.object.mode_set(mode="OBJECT")
        stored = bridge("mesh").read_atlas(obj, "UVMap")
        corners = core("cuts").same_faces(stored, plan.atlas)
        self.assertEqual(stored.positions.tobytes(), plan.atlas.positions.tobytes())
        self.assertEqual(stored.corner_uvs.tobytes(), plan.atlas.corner_uvs[corners].tobytes())
        return plan, corners

    def check_means(self, before, after, indices, means, tolerance):
        for name, values in after.items():
            expected = np.einsum("ck,ckd->cd", means, before[name][indices])
            error = np.abs(values - expected).max()
            print(f"    {name:10} off by at most {error:.1e}")
            self.assertLess(error, tolerance.get(name, 2e-6), name)

    def test_what_is_interpolated_follows(self):
        for mode in ("OBJECT", "EDIT"):
            with self.subTest(mode=mode):
                obj = add_rich_mesh()
                points, corners, faces = data_of(obj)
                plan, order = self.cut(obj, mode, lines=MANY_LINES)
                new_points, new_corners, new_faces = data_of(obj)
                old = plan.input_vertex_count
                for name in points:
                    self.assertTrue(np.array_equal(new_points[name][:old], points[name]), name)
                inner = {name: values[old:] for name, values in new_points.items()}
                rounding = {"co": 2e-7, "Basis": 2e-7, "Smile": 3e-7, "Frown": 3e-7}
                self.check_means(points, inner, plan.vertex_sources, plan.vertex_weights, rounding)
                sources, means = plan.corner_sources[order], plan.corner_weights[order]
                self.check_means(corners, new_corners, sources, means, {"Bytes": 1.01 / 255, "Lightmap": 1e-7})
                kept = means[:, 0] == 1
                for name in corners:
                    self.assertTrue(np.array_equal(new_corners[name][kept], corners[name][sources[kept, 0]]), name)
                for name in faces:
                    self.assertTrue(np.array_equal(new_faces[name], faces[name][plan.face_sources]), name)

    def test_other_uv_maps_gain_no_seam(self):
        """Both faces of an edge hold the same bits at a new vertex, where they do so at the edge's ends."""
        obj = add_rich_mesh()
        layer, random = obj.data.uv_layers["Lightmap"], np.random.default_rng(8)
        set_uvs(layer, random.random((len(obj.data.vertices), 2))[[loop.vertex_index for loop in obj.data.loops]])
        self.cut(obj)
        uvs = get_uvs(obj.data.uv_layers["Lightmap"])
        held = {}
        for loop in obj.data.loops:
            held.setdefault(loop.vertex_index, set()).add(uvs[loop.index].tobytes())
        self.assertEqual({len(values) for values in held.values()}, {1})

    def test_custom_normals_follow(self):
        for mode in ("OBJECT", "EDIT"):
            with self.subTest(mode=mode):
                obj = add_rich_mesh()
                before = normals(obj.data)
                plan, order = self.cut(obj, mode)
                error = np.abs(normals(obj.data) - plan.directions(before)[order]).max()
                print(f"    normals off by at most {error:.1e}")
                self.assertLess(error, 2e-3)  # Blender packs an angle into 15 bits

    def test_edges_keep_their_marks_and_new_seams_are_marked(self):
        for mode in ("OBJECT", "EDIT"):
            with self.subTest(mode=mode):
                obj = add_rich_mesh()
                before = edge_data(obj.data)
                plan, _ = self.cut(obj, mode)
                parts = {}
                for split in plan.edge_splits:
                    chain = [split.start, *split.vertices, split.end]
                    parts.update({tuple(sorted(pair)): (split.start, split.end) for pair in itertools.pairwise(chain)})
                seams = {tuple(sorted(pair)) for pair in plan.new_seams.tolist()}
                self.assertTrue(seams)
                for key, (seam, marks) in edge_data(obj.data).items():
                    old_seam, old_marks = before.get(parts.get(key, key), (False, (False, False, 0.0, 0.0, 0.0)))
                    self.assertEqual((seam, marks), (old_seam or key in seams, old_marks), key)

    def test_only_crossed_faces_are_divided(self):
        obj = add_rich_mesh()
        sizes = [len(polygon.vertices) for polygon in obj.data.polygons]
        self.assertEqual(sizes[-1], 6)
        plan, _ = self.cut(obj)
        self.assertEqual(len(obj.data.polygons), len(plan.face_sources))
        pieces = [[polygon for polygon, s in zip(obj.data.polygons, plan.face_sources, strict=True) if s == k] for k in range(11)]
        self.assertEqual([len(row) for row in pieces], [2, 4, 2, 2, 2, 3, 1, 1, 1, 1, 1])
        self.assertEqual(len(pieces[10][0].vertices), 6, "the hexagon that no cut touches")
        self.assertEqual(len(pieces[9][0].vertices), 5, "a quad whose edge gained a vertex")
        self.assertFalse(obj.data.validate(verbose=True))
        used = {key for polygon in obj.data.polygons for key in polygon.edge_keys}
        self.assertEqual(used, {edge.key for edge in obj.data.edges}, "an edge without a face")

    def test_a_cut_through_the_hexagon(self):
        obj = add_rich_mesh()
        plan, _ = self.cut(obj, lines=[(0, 3.25, [10]), (1, 2.25, [10], 3.25)])
        self.assertEqual(np.bincount(plan.face_sources).tolist(), [1] * 10 + [3])

    def test_doubled_vertices_stay_apart(self):
        """Two quads of the same positions along their common side, as importers make them: a cut across both."""
        positions, offsets, corners, uvs = shapes.join(shapes.grid(2, 1))
        cut, cut_uvs = Cutter(positions, offsets, corners, uvs).cut(1, 0.5).result()
        apart = {1: 6, 4: 7}
        corners = [apart.get(vertex, vertex) if k >= 4 else vertex for k, vertex in enumerate(corners.tolist())]
        obj = add_mesh((np.concatenate([positions, positions[[1, 4]]]), offsets, np.array(corners), uvs))
        sources = np.repeat(cut.face_sources, np.diff(cut.face_offsets)).tolist()
        moved = [vertex + 2 if vertex >= 6 else vertex for vertex in cut.corner_vertices.tolist()]
        moved = [apart.get(vertex, vertex) if face == 1 else vertex for vertex, face in zip(moved, sources, strict=True)]
        cut.corner_vertices, cut.new_seams = np.array(moved, dtype=np.int32), cut.new_seams + 2
        plan = core("cuts").plan_cut(bridge("mesh").read_atlas(obj, "UVMap"), cut, cut_uvs)
        bridge("cuts").write_cut(obj, "UVMap", plan)
        self.assertEqual((len(obj.data.polygons), len(obj.data.vertices), len(obj.data.edges)), (4, 12, 14))
        self.assertFalse(obj.data.validate(verbose=True))
        used = {key for polygon in obj.data.polygons for key in polygon.edge_keys}
        self.assertEqual(used, {edge.key for edge in obj.data.edges}, "an edge without a face")
        self.assertEqual(sum(edge.use_seam for edge in obj.data.edges), 2)

    def test_selection_and_hiding_follow(self):
        for mode in ("OBJECT", "EDIT"):
            with self.subTest(mode=mode):
                obj = add_rich_mesh()
                select_and_hide(obj.data, selected={0, 5}, hidden={1})
                plan, _ = self.cut(obj, mode)
                selected = {plan.face_sources[polygon.index] for polygon in obj.data.polygons if polygon.select}
                unselected = {plan.face_sources[polygon.index] for polygon in obj.data.polygons if not polygon.select}
                self.assertEqual((selected, selected & unselected), ({0, 5}, set()))
                hidden = {plan.face_sources[polygon.index] for polygon in obj.data.polygons if polygon.hide}
                self.assertEqual(hidden, {1})
                sides = {}
                for polygon in obj.data.polygons:
                    for key in polygon.edge_keys:
                        sides.setdefault(key, set()).add(polygon.hide)
                self.assertEqual([edge.hide for edge in obj.data.edges], [sides[edge.key] == {True} for edge in obj.data.edges])

    def test_the_rest_of_the_mesh_stays(self):
        names = ["materials", "vertex groups", "uv maps", "active uv map", "render uv map", "matrix", "modifiers", "mode"]
        for mode in ("OBJECT", "EDIT"):
            with self.subTest(mode=mode):
                obj = add_rich_mesh()
                obj.data["asset"] = "hero"
                obj.data.uv_layers.active_index = 1
                obj.data.uv_layers["Lightmap"].active_render = True
                obj.data.attributes.active_color = obj.data.attributes["Bytes"]
                twin = bpy.data.objects.new("Twin", obj.data)
                before = snapshot(obj)
                self.cut(obj, mode)
                after = snapshot(obj)
                self.assertEqual({name: after[name] for name in names}, {name: before[name] for name in names})
                self.assertEqual(after["custom properties"], before["custom properties"])
                self.assertEqual(obj.data.attributes.active_color.name, "Bytes")
                self.assertIs(twin.data, obj.data)

    def test_edit_mode_still_moves_shape_keys_with_their_basis(self):
        obj = add_rich_mesh(custom_normals=False)
        obj.active_shape_key_index = 0
        bpy.ops.object.mode_set(mode="EDIT")
        plan = make_plan(obj)
        bridge("cuts").write_cut(obj, "UVMap", plan)
        live = bmesh.from_edit_mesh(obj.data)
        for vertex in live.verts:
            vertex.co.z += 2.0
        bmesh.update_edit_mesh(obj.data)
        bpy.ops.object.mode_set(mode="OBJECT")
        moved = shape(obj, "Basis") - plan.atlas.positions
        self.assertLess(np.abs(moved - [0.0, 0.0, 2.0]).max(), 1e-6)

    def test_edit_mode_of_another_shape_key(self):
        obj = add_rich_mesh()
        before = {key.name: shape(obj, key.name) for key in obj.data.shape_keys.key_blocks}
        cut = make_cut(obj, MANY_LINES)
        obj.active_shape_key_index = 1
        bpy.ops.object.mode_set(mode="EDIT")
        plan = core("cuts").plan_cut(bridge("mesh").read_atlas(obj, "UVMap"), *cut)
        bridge("cuts").write_cut(obj, "UVMap", plan)
        bpy.ops.object.mode_set(mode="OBJECT")
        old = plan.input_vertex_count
        for name, values in before.items():
            self.assertTrue(np.array_equal(shape(obj, name)[:old], values), name)
            means = np.einsum("vk,vkd->vd", plan.vertex_weights, values[plan.vertex_sources])
            self.assertLess(np.abs(shape(obj, name)[old:] - means).max(), 3e-7, name)

    def test_a_failure_leaves_every_bit(self):
        def a_piece_twice(plan):
            vertices = plan.atlas.corner_vertices.copy()
            self.assertEqual(plan.face_sources[:2].tolist(), [0, 0])
            vertices[5:10] = vertices[:5]
            return dataclasses.replace(plan, atlas=dataclasses.replace(plan.atlas, corner_vertices=vertices))

        def other_position(plan):
            positions = plan.atlas.positions.copy()
            positions[0, 0] += 0.5  # of an input vertex: not what the mesh holds
            return dataclasses.replace(plan, atlas=dataclasses.replace(plan.atlas, positions=positions))

        def no_edge_split(plan):
            return dataclasses.replace(plan, edge_splits=plan.edge_splits[:-1])

        for mode in ("OBJECT", "EDIT"):
            for spoil in (a_piece_twice, other_position, no_edge_split):
                with self.subTest(mode=mode, spoil=spoil.__name__):
                    obj = add_rich_mesh()
                    if mode == "EDIT":  # one visit alone packs custom normals anew
                        bpy.ops.object.mode_set(mode="EDIT")
                        bpy.ops.object.mode_set(mode="OBJECT")
                    before, meshes = snapshot(obj), len(bpy.data.meshes)
                    bpy.ops.object.mode_set(mode=mode)
                    plan = spoil(make_plan(obj))
                    with self.assertRaises((ValueError, bridge("mesh").MeshError)):
                        bridge("cuts").write_cut(obj, "UVMap", plan)
                    self.assertEqual(obj.mode, mode)
                    bpy.ops.object.mode_set(mode="OBJECT")
                    self.assertEqual(changes(before, snapshot(obj)), [])
                    self.assertEqual(len(bpy.data.meshes), meshes)

    def test_what_cannot_be_divided_is_refused(self):
        check = bridge("cuts").check_divisible
        obj = add_rich_mesh()
        check(obj)
        obj.modifiers.new("Detail", "MULTIRES")
        with self.assertRaisesRegex(bridge("mesh").MeshError, "Multiresolution"):
            check(obj)
        obj.modifiers.clear()
        bpy.ops.object.mode_set(mode="SCULPT")
        with self.assertRaisesRegex(bridge("mesh").MeshError, "object mode or edit mode"):
            check(obj)
        bpy.ops.object.mode_set(mode="EDIT")
        twin = bpy.data.objects.new("Twin", obj.data)
        with self.assertRaisesRegex(bridge("mesh").MeshError, "another object"):
            check(twin)
