"""A cut mesh written into Blender's: everything that vertices, edges, faces and corners carry follows. The cuts are made by hand."""

import dataclasses
import importlib
import itertools
import unittest

import bmesh
import bpy
import numpy as np
import shapes
from cuts import Cutter
from support import HAS_UV_ATTRIBUTE, MODULE, add_mesh, changes, fresh_scene, get_uvs, set_uvs, snapshot

LINES = ((0, 1.27, range(8)), (1, 0.43, None), (1, 1.59, [4, 5], 1.27))  # the last one ends in a T-joint inside of face 5

MANY_LINES = [(0, 0.37 * k) for k in range(1, 11)] + [(1, 0.29 * k) for k in range(1, 11)]


def bridge(name):
    return importlib.import_module(f"{MODULE}.bridge.{name}")


def core(name):
    return importlib.import_module(f"{MODULE}.core.{name}")


def grid_with_an_ngon():
    """4 x 3 quads; the two in the corner are one hexagon."""
    positions, offsets, corners, uvs = shapes.join(shapes.grid(4, 3))
    positions[:, 2] = 0.3 * np.sin(positions[:, 0] + positions[:, 1])
    faces = [corners[4 * k : 4 * k + 4].tolist() for k in range(12)]
    faces[-2:] = [[12, 13, 14, 19, 18, 17]]
    uv_of = dict(zip(corners.tolist(), uvs.tolist(), strict=True))
    flat = [vertex for face in faces for vertex in face]
    sizes = [len(face) for face in faces]
    return positions, np.cumsum([0] + sizes), np.array(flat), np.array([uv_of[vertex] for vertex in flat]) / 4


def add_rich_mesh(custom_normals=True):
    """An object that carries one of everything that a cut must take along."""
    obj = add_mesh(grid_with_an_ngon(), name="Rich")
    mesh, random = obj.data, np.random.default_rng(3)
    if HAS_UV_ATTRIBUTE:  # Blender 4.5 corrupts its heap where setting a pin makes the layer of pins
        mesh.attributes.new(".pn.UVMap", "BOOLEAN", "CORNER")
    set_uvs(mesh.uv_layers.new(name="Lightmap"), random.random((len(mesh.loops), 2)))
    mesh.uv_layers.active_index = 0
    for name in ("Spine", "Arm"):
        group = obj.vertex_groups.new(name=name)
        for vertex, weight in enumerate(random.random(len(mesh.vertices))):
            group.add([vertex], weight, "REPLACE")
    for name, domain, kind in (
        ("Paint", "CORNER", "FLOAT_COLOR"),
        ("Bytes", "CORNER", "BYTE_COLOR"),
        ("Mask", "POINT", "FLOAT_COLOR"),
    ):
        colours = mesh.color_attributes.new(name, kind, domain)
        colours.data.foreach_set("color", random.random(4 * len(colours.data)).astype(np.float32))
    for name, domain in (("wear", "POINT"), ("stress", "EDGE"), ("heat", "FACE"), ("dirt", "CORNER")):
        mesh.attributes.new(name, "FLOAT", domain)
        attribute = mesh.attributes[name]
        attribute.data.foreach_set("value", random.random(len(attribute.data)).astype(np.float32))
    mesh.attributes.new("part", "INT", "FACE").data.foreach_set("value", np.arange(len(mesh.polygons)))
    for name in ("Skin", "Cloth", "Metal"):
        mesh.materials.append(bpy.data.materials.new(name))
    for polygon in mesh.polygons:
        polygon.material_index, polygon.use_smooth = polygon.index % 3, polygon.index != 5
    for edge in mesh.edges:
        edge.use_seam, edge.use_edge_sharp = edge.index % 7 == 0, edge.index % 4 == 0
        if hasattr(edge, "use_freestyle_mark"):
            edge.use_freestyle_mark = edge.index % 3 == 0
    for name in ("crease", "bevel_weight"):
        set_edge_values(mesh, name, random.random(len(mesh.edges)).astype(np.float32))
    if custom_normals:
        add_custom_normals(mesh, random)
    obj.shape_key_add(name="Basis")
    for name in ("Smile", "Frown"):
        key = obj.shape_key_add(name=name)
        moved = random.normal(size=(len(key.data), 3)) + shape(obj, "Basis")
        key.data.foreach_set("co", moved.astype(np.float32).ravel())
    return obj


def edge_values(mesh, name):
    """(the collection, its attribute) that hold creases or bevel weights of edges."""
    if hasattr(mesh.edges[0], name):  # before 4.0
        return mesh.edges, name
    if f"{name}_edge" not in mesh.attributes:
        mesh.attributes.new(f"{name}_edge", "FLOAT", "EDGE")
    return mesh.attributes[f"{name}_edge"].data, "value"


def set_edge_values(mesh, name, values):
    collection, attribute = edge_values(mesh, name)
    collection.foreach_set(attribute, values)


def get_edge_values(mesh, name):
    collection, attribute = edge_values(mesh, name)
    return column(collection, attribute)[:, 0]


def add_custom_normals(mesh, random):
    """One for each vertex and side of its sharp edges: others Blender would average or make more edges sharp for."""
    if hasattr(mesh, "use_auto_smooth"):
        mesh.use_auto_smooth = True
        mesh.auto_smooth_angle = np.pi
    tilt = random.normal(size=(len(mesh.vertices), 3)) * 0.2 + [0.0, 0.0, 1.0]
    tilt /= np.linalg.norm(tilt, axis=1, keepdims=True)
    mesh.normals_split_custom_set([tilt[loop.vertex_index].tolist() for loop in mesh.loops])
    mesh.update()


def select_and_hide(mesh, selected, hidden):
    """By a BMesh: Blender 5.0 crashes where MeshEdge.select is set."""
    flagged = bmesh.new()
    flagged.from_mesh(mesh)
    for element in (*flagged.faces, *flagged.edges, *flagged.verts):
        element.select_set(False)
    for face in flagged.faces:
        if face.index in selected:
            face.select_set(True)
        if face.index in hidden:
            face.hide_set(True)
    flagged.to_mesh(mesh)
    flagged.free()


def column(collection, attribute, width=1, dtype=np.float32):
    values = np.empty(width * len(collection), dtype=dtype)
    collection.foreach_get(attribute, values)
    return values.reshape(-1, width).astype(np.float64) if dtype == np.float32 else values


def shape(obj, name):
    return column(obj.data.shape_keys.key_blocks[name].data, "co", 3)


def weights(obj):
    rows = np.zeros((len(obj.data.vertices), len(obj.vertex_groups)))
    for vertex in obj.data.vertices:
        for group in vertex.groups:
            rows[vertex.index, group.group] = group.weight
    return rows


def normals(mesh):
    return bridge("versions").custom_normals(mesh).astype(np.float64)


def data_of(obj):
    """Everything that is interpolated, by domain: name -> (n, k) arrays."""
    mesh = obj.data
    points = {
        "weights": weights(obj),
        "co": column(mesh.vertices, "co", 3),
        "Mask": column(mesh.attributes["Mask"].data, "color", 4),
    }
    points["wear"] = column(mesh.attributes["wear"].data, "value")
    points.update({key.name: shape(obj, key.name) for key in mesh.shape_keys.key_blocks})
    corners = {"Paint": column(mesh.attributes["Paint"].data, "color", 4)}
    corners["Bytes"] = column(mesh.attributes["Bytes"].data, "color_srgb", 4)  # as they are stored and interpolated
    corners["dirt"] = column(mesh.attributes["dirt"].data, "value")
    corners["Lightmap"] = get_uvs(mesh.uv_layers["Lightmap"]).astype(np.float64)
    faces = {name: column(mesh.attributes[name].data, "value") for name in ("heat",)}
    faces["part"] = column(mesh.attributes["part"].data, "value", dtype=np.int32)
    for name in ("material_index", "use_smooth"):
        faces[name] = column(mesh.polygons, name, dtype=np.int32 if name == "material_index" else bool)
    return points, corners, faces


def edge_data(mesh):
    """(seam, whatever else it carries) of each edge by its vertices."""
    stress = column(mesh.attributes["stress"].data, "value")[:, 0]
    marks = [edge.use_edge_sharp for edge in mesh.edges], [getattr(edge, "use_freestyle_mark", False) for edge in mesh.edges]
    rows = zip(*marks, stress, get_edge_values(mesh, "crease"), get_edge_values(mesh, "bevel_weight"), strict=True)
    return {edge.key: (edge.use_seam, row) for edge, row in zip(mesh.edges, rows, strict=True)}


def make_plan(obj, lines=LINES):
    """The plan of a cut along these lines, and the CutMesh's new seams."""
    atlas = bridge("mesh").read_atlas(obj, "UVMap")
    cutter = Cutter(*atlas.as_tuple())
    for line in lines:
        cutter.cut(*line)
    cut, uvs = cutter.result(shift=0.05)
    return core("cuts").plan_cut(atlas, cut, uvs)


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

    def test_doubled_vertices_stay_apart_beside_a_shared_new_one(self):
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
        self.assertEqual(len(obj.data.polygons), 4)
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

    def test_a_failure_leaves_every_bit(self):
        def no_edge(plan):
            return dataclasses.replace(plan, new_seams=np.array([[0, 19]]))

        def other_position(plan):
            positions = plan.atlas.positions.copy()
            positions[0, 0] += 0.5  # of an input vertex: not what the mesh holds
            return dataclasses.replace(plan, atlas=dataclasses.replace(plan.atlas, positions=positions))

        for mode in ("OBJECT", "EDIT"):
            for spoil in (no_edge, other_position):
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
