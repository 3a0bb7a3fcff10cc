"""bpy.ops.uv.atlas_refine(seams='RECTANGLES') on Suzanne: what her mesh carries is linear in space, and is so after the cut."""

import dataclasses
import sys
import unittest
import unittest.mock

import bmesh
import bpy
import numpy as np
from support import MODULE, add_mesh, changes, fresh_scene, get_uvs, packing_efficiency, set_uvs, snapshot


def region(face):
    """Front and back of the ears, the back of the head, and the two halves of the face."""
    x, y, _ = face.center
    if abs(x) > 0.82:
        return "ear", x > 0, face.normal.y > 0
    return ("back",) if y > 0.2 else ("face", x > 0)


def add_suzanne(levels=1):
    """Subdivided and unwrapped along marked seams: quads, triangles, open borders."""
    bpy.ops.mesh.primitive_monkey_add()
    obj = bpy.context.object
    sides = {}
    for face in obj.data.polygons:
        for key in face.edge_keys:
            sides.setdefault(key, set()).add(region(face))
    for edge in obj.data.edges:
        edge.use_seam = len(sides[edge.key]) > 1
    obj.modifiers.new("Subdivision", "SUBSURF").levels = levels
    bpy.ops.object.modifier_apply(modifier="Subdivision")
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.uv.unwrap(method="ANGLE_BASED", margin=0.003)
    bpy.ops.object.mode_set(mode="OBJECT")
    for edge, torn in zip(obj.data.edges, torn_edges(obj.data), strict=True):
        edge.use_seam = torn
    return obj


def torn_edges(mesh):
    """For each edge whether its two faces hold other UVs at it."""
    uvs = get_uvs(mesh.uv_layers[0])
    sides = {}
    for polygon in mesh.polygons:
        loops = list(polygon.loop_indices)
        for a, b in zip(loops, loops[1:] + loops[:1], strict=True):
            ends = sorted((mesh.loops[loop].vertex_index, uvs[loop].tobytes()) for loop in (a, b))
            sides.setdefault((ends[0][0], ends[1][0]), set()).add((ends[0][1], ends[1][1]))
    return [len(sides[edge.key]) > 1 for edge in mesh.edges]


def linear(points, columns):
    """Values in [0, 1] that are linear in space, Suzanne lying within 1.5 of the origin."""
    slopes = np.array([[0.2, 0.1, 0.3], [0.3, -0.2, 0.1], [-0.1, 0.3, 0.2]])[:columns]
    return 0.5 + points @ slopes.T / 3.0


def positions(mesh):
    flat = np.empty(3 * len(mesh.vertices), dtype=np.float32)
    mesh.vertices.foreach_get("co", flat)
    return flat.reshape(-1, 3).astype(np.float64)


def corner_positions(mesh):
    return positions(mesh)[[loop.vertex_index for loop in mesh.loops]]


def add_linear_data(obj):
    mesh = obj.data
    set_uvs(mesh.uv_layers.new(name="Lightmap"), linear(corner_positions(mesh), 2))
    colour = mesh.color_attributes.new(name="Paint", type="FLOAT_COLOR", domain="CORNER")
    rgba = np.hstack([linear(corner_positions(mesh), 3), np.ones((len(mesh.loops), 1))])
    colour.data.foreach_set("color", rgba.astype(np.float32).ravel())
    group = obj.vertex_groups.new(name="Spine")
    for vertex, weight in enumerate(linear(positions(mesh), 1)[:, 0]):
        group.add([vertex], weight, "REPLACE")
    obj.shape_key_add(name="Basis")
    key = obj.shape_key_add(name="Big")
    key.data.foreach_set("co", linear(positions(mesh), 3).astype(np.float32).ravel())
    mesh.uv_layers.active_index = 0


def linear_data(obj):
    """(values, what they should be) by name."""
    mesh = obj.data
    colours = np.empty(4 * len(mesh.loops), dtype=np.float32)
    mesh.color_attributes["Paint"].data.foreach_get("color", colours)
    key = np.empty(3 * len(mesh.vertices), dtype=np.float32)
    obj.data.shape_keys.key_blocks["Big"].data.foreach_get("co", key)
    weights = np.array([[vertex.groups[0].weight] for vertex in mesh.vertices])
    return {
        "Lightmap": (get_uvs(mesh.uv_layers["Lightmap"]), linear(corner_positions(mesh), 2)),
        "Paint": (colours.reshape(-1, 4)[:, :3], linear(corner_positions(mesh), 3)),
        "Spine": (weights, linear(positions(mesh), 1)),
        "Big": (key.reshape(-1, 3), linear(positions(mesh), 3)),
    }


def surface(mesh):
    """(area, Euler characteristic)."""
    built = bmesh.new()
    built.from_mesh(mesh)
    area = sum(face.calc_area() for face in bmesh.ops.triangulate(built, faces=built.faces)["faces"])
    built.free()
    return area, len(mesh.vertices) - len(mesh.edges) + len(mesh.polygons)


class Rectangles(unittest.TestCase):
    def setUp(self):
        fresh_scene()

    def check_cut(self, mode):
        obj = add_suzanne()
        add_linear_data(obj)
        mesh = obj.data
        faces, old_positions, old_surface = len(mesh.polygons), positions(mesh), surface(mesh)
        bpy.ops.object.mode_set(mode=mode)
        done = bpy.ops.uv.atlas_refine(seams="RECTANGLES", cut="SPLIT", sigma=0.004, pe_bound=0.8, density="EQUAL")
        self.assertEqual((done, obj.mode), ({"FINISHED"}, mode))
        bpy.ops.object.mode_set(mode="OBJECT")
        mesh = obj.data
        self.assertGreaterEqual(packing_efficiency(mesh, mesh.uv_layers[0]), 0.8)
        self.assertGreater(len(mesh.polygons), faces)
        self.assertTrue(np.array_equal(positions(mesh)[: len(old_positions)], old_positions))
        self.assertAlmostEqual(surface(mesh)[0], old_surface[0], delta=1e-4 * old_surface[0])
        self.assertEqual(surface(mesh)[1], old_surface[1])
        self.assertFalse(mesh.validate(verbose=True))
        untorn = [edge.key for edge, torn in zip(mesh.edges, torn_edges(mesh), strict=True) if edge.use_seam and not torn]
        self.assertEqual(untorn, [])
        unmarked = [edge.key for edge, torn in zip(mesh.edges, torn_edges(mesh), strict=True) if torn and not edge.use_seam]
        self.assertEqual(unmarked, [])
        for name, (values, expected) in linear_data(obj).items():
            self.assertLess(np.abs(values - expected).max(), 1e-6, name)

    def test_in_object_mode(self):
        self.check_cut("OBJECT")

    def test_in_edit_mode(self):
        self.check_cut("EDIT")

    def test_faces_that_no_cut_crosses_stay_one(self):
        obj = add_suzanne()
        uvs = obj.data.uv_layers.active.name
        quads = sum(len(polygon.vertices) == 4 for polygon in obj.data.polygons)
        index = obj.data.attributes.new("index", "INT", "FACE")
        index.data.foreach_set("value", np.arange(len(obj.data.polygons)))
        bpy.ops.uv.atlas_refine(seams="RECTANGLES", cut="SPLIT", density="EQUAL")
        self.assertEqual(obj.data.uv_layers.active.name, uvs)
        source = np.empty(len(obj.data.polygons), dtype=np.int32)
        obj.data.attributes["index"].data.foreach_get("value", source)
        whole = np.bincount(source) == 1
        left = sum(whole[source[polygon.index]] and len(polygon.vertices) == 4 for polygon in obj.data.polygons)
        print(f"    {left} of {quads} quads are as they were")
        self.assertGreater(left, quads / 2)

    def test_edges_without_length_may_be_cut(self):
        for add, every in ((bpy.ops.mesh.primitive_monkey_add, 5), (bpy.ops.mesh.primitive_torus_add, 14)):
            add()
            obj = bpy.context.object
            bpy.ops.object.mode_set(mode="EDIT")
            bpy.ops.mesh.select_all(action="SELECT")
            bpy.ops.uv.smart_project()
            bpy.ops.object.mode_set(mode="OBJECT")
            for polygon in list(obj.data.polygons)[::every]:
                a, b = polygon.vertices[:2]
                obj.data.vertices[b].co = obj.data.vertices[a].co
            faces = len(obj.data.polygons)
            self.assertEqual(bpy.ops.uv.atlas_refine(seams="RECTANGLES", cut="SPLIT", density="EQUAL"), {"FINISHED"})
            self.assertGreater(len(obj.data.polygons), faces)
            self.assertFalse(obj.data.validate())

    def test_a_map_that_holds_the_bound_stays(self):
        obj = add_suzanne()
        bpy.ops.uv.atlas_refine(seams="RECTANGLES", cut="SPLIT", density="EQUAL")
        before = snapshot(obj)
        self.assertEqual(bpy.ops.uv.atlas_refine(seams="RECTANGLES", cut="SPLIT", density="EQUAL"), {"FINISHED"})
        self.assertEqual(changes(before, snapshot(obj)), [])

    def test_failures_leave_the_mesh_alone(self):
        obj = add_suzanne()
        before = snapshot(obj)
        for sigma in (-0.1, 0.5):
            with self.assertRaisesRegex(RuntimeError, "Suzanne: sigma"):
                bpy.ops.uv.atlas_refine(seams="RECTANGLES", cut="SPLIT", sigma=sigma)
            self.assertEqual(changes(before, snapshot(obj)), [])
        uvs = get_uvs(obj.data.uv_layers.active)
        uvs[:] = np.nan
        set_uvs(obj.data.uv_layers.active, uvs)
        before = snapshot(obj)
        with self.assertRaisesRegex(RuntimeError, "Suzanne: no face has UVs"):
            bpy.ops.uv.atlas_refine(seams="RECTANGLES", cut="SPLIT")
        self.assertEqual(changes(before, snapshot(obj)), [])

    def test_a_multiresolution_mesh_and_sculpt_mode_are_refused(self):
        obj = add_mesh()
        obj.modifiers.new("Detail", "MULTIRES")
        before = snapshot(obj)
        with self.assertRaisesRegex(RuntimeError, "Multiresolution"):
            bpy.ops.uv.atlas_refine(seams="RECTANGLES", cut="SPLIT")
        self.assertEqual(changes(before, snapshot(obj)), [])
        self.assertEqual(bpy.ops.uv.atlas_refine(), {"FINISHED"})
        obj.modifiers.clear()
        bpy.ops.object.mode_set(mode="SCULPT")
        with self.assertRaisesRegex(RuntimeError, "object mode or edit mode"):
            bpy.ops.uv.atlas_refine(seams="RECTANGLES", cut="SPLIT")
        bpy.ops.object.mode_set(mode="OBJECT")

    def test_every_user_of_a_mesh_gets_the_cut(self):
        obj = add_mesh()
        twin = bpy.data.objects.new("Twin", obj.data)
        bpy.context.collection.objects.link(twin)
        faces = len(obj.data.polygons)
        self.assertEqual(bpy.ops.uv.atlas_refine(seams="RECTANGLES", cut="SPLIT"), {"FINISHED"})
        self.assertIs(twin.data, obj.data)
        self.assertGreater(len(twin.data.polygons), faces)

    def run_for(self, steps):
        """Two objects, cut beside a window that is closed, or the add-on disabled, after so many steps of writing. Returns whether that
        was before their end."""
        fresh_scene()
        objs = [add_mesh(name=name) for name in ("First", "Second")]
        for obj in objs:
            obj.select_set(True)
        before = [snapshot(obj) for obj in objs]
        if steps % 2:
            bpy.ops.object.mode_set(mode="EDIT")
        options = sys.modules[f"{MODULE}.properties"].to_options(bpy.context.scene.atlas_refine)
        options = dataclasses.replace(options, seams="RECTANGLES", cut="SPLIT", write_to="COPY")
        meshes = len(bpy.data.meshes)
        run = sys.modules[f"{MODULE}.tasks"].Run(bpy.context, options, beside_window=True)
        while not run.done:
            run.step()
        work = sys.modules[f"{MODULE}.core.steps"]._Work
        with unittest.mock.patch.object(work, "start", work.run):  # each step goes on
            ended = any(run.step() for _ in range(steps))
        run.stop()
        if steps % 2:
            bpy.ops.object.mode_set(mode="OBJECT")
        self.assertEqual(len(bpy.data.meshes), meshes)
        changed = [changes(held, snapshot(obj)) for held, obj in zip(before, objs, strict=True)]
        divided = ["corner vertices" in names for names in changed]
        self.assertIn(divided, ([False] * 2, [True] * 2), steps)
        if not any(divided):
            self.assertEqual(changed, [[], []])
        return not ended

    def test_whenever_it_is_stopped_all_is_as_before_or_cut(self):
        steps = 0
        while self.run_for(steps):
            steps += 1
        print(f"    {steps} steps")
