"""bpy.ops.uv.atlas_refine() in the background: the bound is met on what Blender stores; failures leave the mesh alone."""

import sys
import time
import unittest

import bpy
import numpy as np
import shapes
from support import MODULE, add_mesh, changes, fresh_scene, get_uvs, packing_efficiency, set_uvs, snapshot, texture_share


class Operator(unittest.TestCase):
    def setUp(self):
        fresh_scene()

    def assert_refused(self, obj, words, **options):
        before = snapshot(obj)
        with self.assertRaises(RuntimeError) as caught:
            bpy.ops.uv.atlas_refine(**options)
        for word in (obj.name, *words):
            self.assertIn(word, str(caught.exception))
        self.assertEqual(changes(before, snapshot(obj)), [])

    def test_the_bound_is_met_on_the_stored_values(self):
        for pe_bound in (0.8, 0.85):
            obj = add_mesh()
            layer = obj.data.uv_layers.active
            self.assertLess(packing_efficiency(obj.data, layer), 0.5)
            self.assertEqual(bpy.ops.uv.atlas_refine(pe_bound=pe_bound), {"FINISHED"})
            self.assertGreaterEqual(packing_efficiency(obj.data, layer), pe_bound)

    def test_what_was_not_adjusted_is_not_refined_again(self):
        obj = add_mesh()
        before = snapshot(obj)
        self.assertEqual(bpy.ops.uv.atlas_refine_again(), {"CANCELLED"})
        self.assertEqual(changes(before, snapshot(obj)), [])

    def test_cuts_along_edges_mark_seams_and_leave_the_mesh_as_it_is(self):
        obj = add_mesh()
        before = snapshot(obj)
        self.assertEqual(bpy.ops.uv.atlas_refine(seams="RECTANGLES", pe_bound=0.8), {"FINISHED"})
        self.assertGreaterEqual(packing_efficiency(obj.data, obj.data.uv_layers.active), 0.8)
        seams = [edge.key for edge in obj.data.edges if edge.use_seam]
        self.assertGreater(len(seams), 0)
        for edge in obj.data.edges:
            edge.use_seam = False
        self.assertEqual([name for name in changes(before, snapshot(obj)) if "uv" not in name.lower()], [])

    def test_a_sphere_seen_from_above_is_parted_where_stacks_are(self):
        bpy.ops.mesh.primitive_uv_sphere_add(segments=12, ring_count=8)
        obj = bpy.context.object
        layer = obj.data.uv_layers.active or obj.data.uv_layers.new()
        uvs = [obj.data.vertices[loop.vertex_index].co.xy for loop in obj.data.loops]
        set_uvs(layer, np.array(uvs, dtype=np.float32))
        # Seen from above its halves lie on each other, as those of a Mirror modifier do.
        self.assertEqual(bpy.ops.uv.atlas_refine(pe_bound=0.7, stacks="SEPARATE"), {"FINISHED"})
        self.assertGreaterEqual(packing_efficiency(obj.data, obj.data.uv_layers.active), 0.7)

    def test_a_copy_of_the_mesh_keeps_its_uvs(self):
        """Blender's copies share arrays until one of the two is written."""
        obj = add_mesh()
        copied = obj.data.copy()
        before = get_uvs(copied.uv_layers[0]).tobytes()
        bpy.ops.uv.atlas_refine()
        self.assertNotEqual(get_uvs(obj.data.uv_layers[0]).tobytes(), before)
        self.assertEqual(get_uvs(copied.uv_layers[0]).tobytes(), before)

    def test_one_undo_step_takes_it_back(self):
        before = snapshot(add_mesh())
        bpy.ops.ed.undo_push(message="before")
        bpy.ops.uv.atlas_refine("EXEC_DEFAULT", True)
        self.assertNotEqual(changes(before, snapshot(bpy.data.objects["Loose"])), [])
        bpy.ops.ed.undo()
        self.assertEqual(changes(before, snapshot(bpy.data.objects["Loose"])), [])

    def test_the_default_bound_is_080(self):
        obj = add_mesh()
        bpy.ops.uv.atlas_refine()
        self.assertGreaterEqual(packing_efficiency(obj.data, obj.data.uv_layers.active), 0.8)

    def test_a_square(self):
        obj = add_mesh()
        layer = obj.data.uv_layers.active
        bpy.ops.uv.atlas_refine(pe_bound=0.8, aspect="SQUARE")
        extent = np.ptp(get_uvs(layer).astype(np.float64), axis=0)
        self.assertGreaterEqual(packing_efficiency(obj.data, layer) * np.prod(extent) / extent.max() ** 2, 0.8)

    def test_a_gap_in_pixels(self):
        add_mesh()
        self.assertEqual(
            bpy.ops.uv.atlas_refine(pe_bound=0.75, gap="PIXELS", gap_px=4, texture_size=1024, density="EQUAL"), {"FINISHED"}
        )

    def test_what_is_at_the_bound_stays_bit_for_bit(self):
        obj = add_mesh(shapes.tight())
        before = snapshot(obj)
        self.assertEqual(bpy.ops.uv.atlas_refine(pe_bound=0.9, aspect="FREE", gap="AUTO"), {"FINISHED"})
        self.assertEqual(changes(before, snapshot(obj)), [])

    def test_the_same_seed_gives_the_same_bits(self):
        results = []
        for _ in range(2):
            obj = add_mesh()
            bpy.ops.uv.atlas_refine(seed=7)
            results.append(get_uvs(obj.data.uv_layers.active).tobytes())
        self.assertEqual(results[0], results[1])

    def test_a_uv_map_by_name_and_by_index(self):
        for wanted in ("Second", "1"):
            obj = add_mesh(uv_map="First")
            obj.data.uv_layers.new(name="Second")
            obj.data.uv_layers.active_index = 0
            before = snapshot(obj, but_uvs_of="Second")
            bpy.ops.uv.atlas_refine(uv_map=wanted)
            self.assertEqual(changes(before, snapshot(obj, but_uvs_of="Second")), [])
            self.assertGreaterEqual(packing_efficiency(obj.data, obj.data.uv_layers["Second"]), 0.8)

    def test_a_mesh_with_several_users(self):
        obj = add_mesh()
        twin = bpy.data.objects.new("Twin", obj.data)
        bpy.context.collection.objects.link(twin)
        self.assertEqual(bpy.ops.uv.atlas_refine(), {"FINISHED"})
        self.assertIs(twin.data, obj.data)
        self.assertEqual(obj.data.users, 2)
        self.assertGreaterEqual(packing_efficiency(twin.data, twin.data.uv_layers.active), 0.8)

    def test_no_uv_map(self):
        obj = add_mesh()
        obj.data.uv_layers.remove(obj.data.uv_layers.active)
        self.assert_refused(obj, ["no UV map"])

    def test_no_uv_map_of_that_name(self):
        self.assert_refused(add_mesh(), ["no UV map", "Lightmap"], uv_map="Lightmap")

    def test_no_faces(self):
        mesh = bpy.data.meshes.new("Empty")
        mesh.uv_layers.new(name="UVMap")
        obj = bpy.data.objects.new("Empty", mesh)
        bpy.context.collection.objects.link(obj)
        obj.select_set(True)
        with self.assertRaisesRegex(RuntimeError, "Empty"):
            bpy.ops.uv.atlas_refine()

    def test_no_mesh_object(self):
        with self.assertRaisesRegex(RuntimeError, "Select a mesh object"):
            bpy.ops.uv.atlas_refine()

    def test_a_bound_out_of_range(self):
        for pe_bound in (0.0, 1.0, 1.2):
            self.assert_refused(add_mesh(), [], pe_bound=pe_bound)

    def test_a_face_with_a_uv_that_is_not_a_number_stays_as_it_is(self):
        obj = add_mesh()
        uvs = get_uvs(obj.data.uv_layers.active)
        uvs[13] = np.nan
        set_uvs(obj.data.uv_layers.active, uvs)
        self.assertEqual(bpy.ops.uv.atlas_refine(), {"FINISHED"})
        after = get_uvs(obj.data.uv_layers.active)
        self.assertEqual(after[12:16].tobytes(), uvs[12:16].tobytes())
        self.assertNotEqual(after[16:].tobytes(), uvs[16:].tobytes())
        self.assertEqual(bpy.ops.uv.atlas_refine_measure(), {"FINISHED"})
        uvs[:] = np.nan
        set_uvs(obj.data.uv_layers.active, uvs)
        self.assert_refused(obj, ["no face has UVs: unwrap the mesh"])

    def test_an_object_that_is_renamed_meanwhile(self):
        obj = add_mesh()
        before = snapshot(obj)
        tasks, core = (sys.modules[f"{MODULE}.{name}"] for name in ("tasks", "core.options"))
        run = tasks.Run(bpy.context, core.Options(), beside_window=True)  # nothing is renamed while a script waits
        while not run.is_solving:
            run.step()
        obj.name = "Renamed"
        while not run.step():
            time.sleep(0.01)
        (done,) = run.finish()
        self.assertEqual((run.problems, [name for name, _, _ in done.prints]), ([], ["Renamed"]))
        self.assertEqual(changes(before, snapshot(obj)), ["uvs of UVMap"])
        self.assertGreaterEqual(texture_share(obj), 0.8)

    def test_an_object_that_is_removed_meanwhile(self):
        obj = add_mesh()
        tasks, core = (sys.modules[f"{MODULE}.{name}"] for name in ("tasks", "core.options"))
        run = tasks.Run(bpy.context, core.Options(), beside_window=True)
        while not run.is_solving:
            run.step()
        bpy.data.objects.remove(obj)
        while not run.step():
            time.sleep(0.01)
        self.assertEqual((run.finish(), run.problems), ([], [("Loose", "Loose: it is gone; nothing was written")]))

    def test_a_bound_out_of_reach(self):
        options = {"pe_bound": 0.999, "gap": "PIXELS", "gap_px": 50, "texture_size": 1024}
        self.assert_refused(add_mesh(), ["the margin to the border of the texture leaves 0.81"], **options)
        options["aspect"] = "FREE"
        self.assert_refused(add_mesh(), ["the best found is texture use"], **options)
        obj = add_mesh()
        before = packing_efficiency(obj.data, obj.data.uv_layers.active)
        self.assertEqual(bpy.ops.uv.atlas_refine(best_effort=True, **options), {"FINISHED"})
        self.assertGreater(packing_efficiency(obj.data, obj.data.uv_layers.active), before)

    def test_small_charts_are_not_blown_up_beside_a_stiff_one(self):
        positions, faces, uvs = shapes.grid(1, 1)
        plank = (positions * [1, 16, 1], faces, uvs * [1, 16])
        obj = add_mesh(shapes.join(plank, *(shapes.grid(1, 1, origin=(x, 0.0)) for x in (2.0, 4.0))))
        words = ["the best found is texture use 0.", "for more, 2 charts would grow to over 1.5 times the texel density"]
        self.assert_refused(obj, words, max_distortion=1.2)
        self.assertEqual(bpy.ops.uv.atlas_refine(), {"FINISHED"})  # the plank is stretched instead
        self.assertGreaterEqual(texture_share(obj), 0.8)
        u, v = get_uvs(obj.data.uv_layers.active).astype(np.float64).reshape(-1, 4, 2).transpose(2, 0, 1)
        areas = np.sum(u * np.roll(v, -1, axis=1) - np.roll(u, -1, axis=1) * v, axis=1) / 2
        self.assertLess(max(areas[1:]), 1.5 * sum(areas) / 18)

    def test_advanced_options_reach_the_engine(self):
        obj = add_mesh()
        options = {"relax": True, "candidates": 20, "threads": 1, "seed": 3, "open_closed": False}
        self.assertEqual(bpy.ops.uv.atlas_refine(seams="RECTANGLES", max_distortion=1.5, **options), {"FINISHED"})
        self.assertGreaterEqual(packing_efficiency(obj.data, obj.data.uv_layers.active), 0.8)
        self.assert_refused(add_mesh(), ["no atlas within a distortion of 1.0001"], max_distortion=1.0001)
        self.assert_refused(add_mesh(), ["candidates"], seams="RECTANGLES", candidates=0)
