"""Texel density in pixels per metre, and the overlay's switches; what is drawn is looked at in a window."""

import sys
import unittest

import addon_utils
import bpy
import numpy as np
from support import MODULE, add_mesh, changes, enable_addon, fresh_scene, get_uvs, messages, snapshot


def module(name):
    return sys.modules[f"{MODULE}.{name}"]


def pixels_per_metre(obj, pixels, metres=1.0):
    """From the stored values; for flat quads of one unit, at the object's scale."""
    u, v = np.moveaxis(get_uvs(obj.data.uv_layers.active).astype(np.float64).reshape(-1, 4, 2), 2, 0)
    area = 0.5 * np.sum(u * np.roll(v, -1, axis=1) - np.roll(u, -1, axis=1) * v)
    return pixels * np.sqrt(area / len(obj.data.polygons)) / (obj.scale[0] * metres)


class Density(unittest.TestCase):
    def setUp(self):
        fresh_scene()

    def refined(self, obj, **options):
        bpy.context.view_layer.update()
        self.assertEqual(bpy.ops.uv.atlas_refine(density="VALUE", **options), {"FINISHED"})
        return self.found()

    def found(self):
        (done,) = module("tasks").last
        ((_, density),) = done.densities
        return density

    def test_a_free_box_gets_the_value_with_scale_and_unit(self):
        for scale, metres in ((1.0, 1.0), (2.5, 1.0), (1.0, 0.01)):
            fresh_scene()
            obj = add_mesh()
            obj.scale = (scale,) * 3
            bpy.context.scene.unit_settings.scale_length = metres
            found = self.refined(obj, aspect="FREE", gap="AUTO", texel_density=40.0, texture_size=1024)
            self.assertAlmostEqual(found.after, 40.0, delta=1e-3)
            self.assertAlmostEqual(pixels_per_metre(obj, 1024, metres), 40.0, delta=1e-3)

    def test_a_texture_that_is_large_enough_has_the_value_and_the_margin(self):
        for mode in ("OBJECT", "EDIT"):
            fresh_scene()
            obj = add_mesh()
            obj.scale = (2.0,) * 3
            bpy.ops.object.mode_set(mode=mode)
            if mode == "EDIT":
                bpy.ops.mesh.select_all(action="SELECT")
            found = self.refined(obj, texel_density=20.0, texture_size=1024)
            bpy.ops.object.mode_set(mode="OBJECT")
            self.assertAlmostEqual(found.after, 20.0, delta=1e-3)
            self.assertAlmostEqual(pixels_per_metre(obj, 1024), 20.0, delta=1e-3)
            uvs = get_uvs(obj.data.uv_layers.active).astype(np.float64)
            self.assertGreaterEqual(1024 * min(uvs.min(), (1 - uvs).min()), 4.0)
            self.assertEqual(bpy.ops.uv.atlas_refine(density="VALUE", texel_density=20.0, texture_size=1024), {"FINISHED"})
            (done,) = module("tasks").last
            self.assertEqual(done.result.intervention, "unchanged")

    def test_a_texture_that_is_too_small_is_filled_and_the_size_that_is_needed_told(self):
        obj = add_mesh()
        found = self.refined(obj, texel_density=1000.0, texture_size=1024)
        self.assertAlmostEqual(found.after, pixels_per_metre(obj, 1024), delta=1e-2)
        lines = list(module("core.density").density_lines(found))
        needed = int(lines[2].split(" px:")[0].split()[-1])
        self.assertAlmostEqual(needed / 1024, 1000.0 / found.after, delta=2e-3)

    def test_a_script_is_told_that_the_texture_is_too_small(self):
        add_mesh()
        options = {"density": "VALUE", "texel_density": 1000.0}
        told = messages(bpy.ops.uv.atlas_refine, texture_size=1024, **options)
        found = self.found()
        size = found.size_to_take
        self.assertIn(f"1000 px/m need a texture of {found.needed_px} px and this one has 1024: take {size}", told)
        fresh_scene()
        add_mesh()
        self.assertNotIn("px/m", messages(bpy.ops.uv.atlas_refine, texture_size=size, **options))
        self.assertAlmostEqual(self.found().after, 1000.0, delta=0.1)

    def test_measure_tells_it_and_changes_nothing(self):
        obj = add_mesh()
        before = snapshot(obj)
        bpy.ops.uv.atlas_refine_measure()
        self.assertAlmostEqual(self.found().before, pixels_per_metre(obj, 2048), delta=1e-2)
        self.assertIsNone(self.found().after)
        self.assertEqual(changes(before, snapshot(obj)), [])


class Overlay(unittest.TestCase):
    def setUp(self):
        fresh_scene()

    def test_switches_make_handlers_and_leave_none(self):
        switches = bpy.context.window_manager.atlas_refine_overlay
        handles = module("overlay")._handles
        for layer in ("stretch", "seams", "gap"):
            setattr(switches, layer, True)
            self.assertTrue(getattr(switches, layer))
            self.assertEqual(len(handles), 2)
        for layer in ("stretch", "seams"):
            setattr(switches, layer, False)
        self.assertEqual(len(handles), 2)
        switches.gap = False
        self.assertEqual(handles, [])

    def test_another_file_and_disabling_switch_it_off(self):
        bpy.context.window_manager.atlas_refine_overlay.stretch = True
        fresh_scene()
        self.assertFalse(bpy.context.window_manager.atlas_refine_overlay.stretch)
        bpy.context.window_manager.atlas_refine_overlay.stretch = True
        handles = module("overlay")._handles
        addon_utils.disable(MODULE, default_set=True)
        self.assertEqual(handles, [])
        self.assertFalse(hasattr(bpy.types.WindowManager, "atlas_refine_overlay"))
        enable_addon()

    def test_new_seams_are_those_of_the_last_run(self):
        for cut in ("EDGES", "SPLIT"):
            fresh_scene()
            obj = add_mesh()
            bpy.ops.uv.atlas_refine(seams="RECTANGLES", cut=cut, pe_bound=0.8)
            edges = module("tasks").new_seams(obj.name)
            marked = {tuple(sorted(edge.vertices)) for edge in obj.data.edges if edge.use_seam}
            self.assertEqual({tuple(sorted(edge)) for edge in edges.tolist()}, marked)
            self.assertTrue(marked)
        obj.data.vertices[0].co.x += 1.0
        obj.data.update()
        bpy.context.view_layer.update()
        self.assertEqual(len(module("tasks").new_seams(obj.name)), 0)

    def shown(self, obj):
        bpy.context.view_layer.update()
        return module("bridge.mesh").read_shown_positions(obj, bpy.context.view_layer.depsgraph)

    def test_it_follows_modifiers_and_shape_keys_that_keep_the_faces(self):
        obj = add_mesh()
        plain = self.shown(obj)
        self.assertTrue(np.array_equal(plain, [vertex.co for vertex in obj.data.vertices]))
        obj.modifiers.new("Displace", "DISPLACE").strength = 2.0
        moved = self.shown(obj)
        self.assertEqual(moved.shape, plain.shape)
        self.assertGreater(np.abs(moved - plain).max(), 0.5)
        obj.modifiers.clear()
        obj.shape_key_add(name="Basis")
        key = obj.shape_key_add(name="Up")
        key.data[0].co.z += 3.0
        key.value = 1.0
        self.assertAlmostEqual(float(self.shown(obj)[0, 2] - plain[0, 2]), 3.0, delta=1e-5)

    def test_where_modifiers_make_other_faces_stretch_is_theirs_and_lines_lie_on_the_mesh(self):
        obj = add_mesh()
        modifier = obj.modifiers.new("Subdivision", "SUBSURF")
        modifier.levels = 1
        self.assertIsNone(self.shown(obj))
        switches = bpy.context.window_manager.atlas_refine_overlay
        switches.stretch = True
        self.assertEqual(self.on_the_cage(), [])
        source = self.source(obj)
        self.assertEqual(len(source.evaluated.atlas.face_offsets) - 1, 4 * len(obj.data.polygons))
        switches.gap = True
        self.assertEqual(self.on_the_cage(), ["Lines lie"])
        nodes = bpy.data.node_groups.new("Other", "GeometryNodeTree")
        nodes.outputs.new("NodeSocketGeometry", "Geometry") if hasattr(nodes, "outputs") else nodes.interface.new_socket(
            "Geometry", in_out="OUTPUT", socket_type="NodeSocketGeometry"
        )
        output, cube = nodes.nodes.new("NodeGroupOutput"), nodes.nodes.new("GeometryNodeMeshCube")
        nodes.links.new(cube.outputs[0], output.inputs[0])
        obj.modifiers.new("Other", "NODES").node_group = nodes
        bpy.context.view_layer.update()
        self.assertEqual(self.on_the_cage(), ["Stretch lies", "Lines lie"])
        self.assertIsNone(self.source(obj).evaluated)
        for one in obj.modifiers:
            one.show_viewport = False
        self.assertIsNotNone(self.shown(obj))
        self.assertEqual(self.on_the_cage(), [])
        self.assertIsNone(self.source(obj).evaluated)
        switches.stretch = switches.gap = False

    def on_the_cage(self):
        return list(module("overlay_settings")._on_the_cage(bpy.context))

    def source(self, obj):
        overlay = module("overlay")
        wanted = overlay.Wanted("", "", (), 0, None, (), False)
        return overlay._source(obj, "UVMap", bpy.context.view_layer.depsgraph, wanted, 0)

    def test_keep_best_has_nothing_to_do_while_nothing_runs(self):
        add_mesh()
        self.assertFalse(bpy.ops.uv.atlas_refine_keep_best.poll())
        self.assertIn("Texture use", messages(bpy.ops.uv.atlas_refine_measure))
