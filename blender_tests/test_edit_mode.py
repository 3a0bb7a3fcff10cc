"""The operator in edit mode: reads what is not yet in the mesh, writes, and stays in edit mode."""

import sys
import time
import unittest

import bmesh
import bpy
import numpy as np
import shapes
from support import MODULE, add_mesh, changes, fresh_scene, get_uvs, packing_efficiency, snapshot

#: Edit mode takes at most twice object mode's time, or what Blender takes to write each corner once where that is more, as in 4.2; a
#: loaded machine may make more of it.
MOST_TIMES = 3


class EditMode(unittest.TestCase):
    def setUp(self):
        fresh_scene()
        self.obj = add_mesh()
        bpy.ops.object.mode_set(mode="EDIT")

    def leave(self):
        bpy.ops.object.mode_set(mode="OBJECT")
        return self.obj.data, self.obj.data.uv_layers.active

    def test_the_bound_is_met_and_the_mode_kept(self):
        self.assertEqual(bpy.ops.uv.atlas_refine(pe_bound=0.85), {"FINISHED"})
        self.assertEqual(self.obj.mode, "EDIT")
        self.assertGreaterEqual(packing_efficiency(*self.leave()), 0.85)

    def test_the_result_is_object_modes(self):
        bpy.ops.uv.atlas_refine(pe_bound=0.85)
        in_edit_mode = get_uvs(self.leave()[1])
        twin = add_mesh(name="Twin")
        bpy.ops.uv.atlas_refine(pe_bound=0.85)
        self.assertEqual(in_edit_mode.tobytes(), get_uvs(twin.data.uv_layers.active).tobytes())

    def test_changes_made_in_edit_mode_count(self):
        mesh = bmesh.from_edit_mesh(self.obj.data)
        bmesh.ops.delete(mesh, geom=[face for face in mesh.faces if face.index >= 12 * 4], context="FACES")
        bmesh.update_edit_mesh(self.obj.data)
        self.assertEqual(bpy.ops.uv.atlas_refine(pe_bound=0.8), {"FINISHED"})
        data, layer = self.leave()
        self.assertEqual(len(data.polygons), 12 * 4)
        self.assertGreaterEqual(packing_efficiency(data, layer), 0.8)

    def test_a_failure_leaves_the_mesh_alone(self):
        mesh = bmesh.from_edit_mesh(self.obj.data)
        for face in mesh.faces:
            face.loops[0][mesh.loops.layers.uv.active].uv.x = np.nan
        self.leave()
        before = snapshot(self.obj)
        bpy.ops.object.mode_set(mode="EDIT")
        with self.assertRaisesRegex(RuntimeError, "Loose: no face has UVs"):
            bpy.ops.uv.atlas_refine()
        self.assertEqual(self.obj.mode, "EDIT")
        self.leave()
        self.assertEqual(changes(before, snapshot(self.obj)), [])

    def test_the_longest_names_do_not_disturb(self):
        """For which Blender 4.x has no room beside its own prefixes."""
        self.leave()
        obj = add_mesh(name="Named", uv_map="the longest name that a UV map can have in some Blender: 67 bytes..")
        before = get_uvs(obj.data.uv_layers.active)
        bpy.ops.object.mode_set(mode="EDIT")
        self.assertEqual(bpy.ops.uv.atlas_refine(pe_bound=0.8), {"FINISHED"})
        bpy.ops.object.mode_set(mode="OBJECT")
        self.assertNotEqual(get_uvs(obj.data.uv_layers.active).tobytes(), before.tobytes())

    def test_attributes_of_flags_count(self):
        self.leave()
        results = []
        for name in ("", "Rigid"):
            obj = add_mesh(name=f"With {name}")
            obj.data.attributes.new("Rigid", "BOOLEAN", "FACE").data[60].value = True
            bpy.ops.object.mode_set(mode="EDIT")
            self.assertEqual(bpy.ops.uv.atlas_refine(keep_shape=name, density="EQUAL"), {"FINISHED"})
            bpy.ops.object.mode_set(mode="OBJECT")
            results.append(get_uvs(obj.data.uv_layers.active).tobytes())
        self.assertFalse(results[0] == results[1])

    def test_nothing_is_left_behind(self):
        meshes = len(bpy.data.meshes)
        bpy.ops.uv.atlas_refine()
        self.assertEqual(len(bpy.data.meshes), meshes)


class Speed(unittest.TestCase):
    def setUp(self):
        fresh_scene()

    def seconds(self, obj, mode):
        """Of reading an atlas and of writing it, of the processor's time."""
        atlas_module, bridge = sys.modules[f"{MODULE}.atlas"], sys.modules[f"{MODULE}.bridge.mesh"]
        at_once = sys.modules[f"{MODULE}.core.steps"].at_once
        options = sys.modules[f"{MODULE}.properties"].to_options(bpy.context.scene.atlas_refine)
        bpy.ops.object.mode_set(mode=mode)
        began = time.process_time()
        atlas = atlas_module.Atlas(options, [obj])
        at_once(atlas.read(bpy.context, [obj]))
        (part,) = atlas.parts
        self.assertTrue(bridge.read_atlas(obj, part.uv_map).same_as(part.atlas))
        bridge.write_uvs(obj, part.uv_map, part.atlas.corner_uvs)
        list(atlas.request.densities(options, 1.0))
        return time.process_time() - began

    def seconds_of_blender(self, obj):
        """In edit mode, of writing each corner once, of the processor's time."""
        mesh = bmesh.from_edit_mesh(obj.data)
        layer = mesh.loops.layers.uv.active
        began = time.process_time()
        for face in mesh.faces:
            for loop in face.loops:
                loop[layer].uv = (0.0, 0.0)
        return time.process_time() - began

    def test_edit_mode_takes_about_as_long_as_object_mode(self):
        """The least of several turns, in each of which what is compared runs under the same load of the machine."""
        times = []
        for _ in range(5):
            obj = add_mesh(shapes.join(shapes.grid(150, 150)))
            bpy.ops.object.mode_set(mode="EDIT")
            bpy.ops.mesh.select_all(action="SELECT")
            in_object_mode, in_edit_mode = (self.seconds(obj, mode) for mode in ("OBJECT", "EDIT"))
            of_blender = self.seconds_of_blender(obj)
            bpy.ops.object.mode_set(mode="OBJECT")
            times.append((in_edit_mode / max(in_object_mode, of_blender), in_object_mode, in_edit_mode, of_blender))
        ratio, *seconds = min(times)
        modes = "object mode {:.3f} s, edit mode {:.3f} s, Blender's own writing {:.3f} s".format(*seconds)
        print(f"    {len(obj.data.polygons)} quads: {modes}: {ratio:.2f}", flush=True)
        self.assertLess(ratio, MOST_TIMES)
