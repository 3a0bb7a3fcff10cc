"""The operator in edit mode: reads what is not yet in the mesh, writes, and stays in edit mode."""

import unittest

import bmesh
import bpy
import numpy as np
from support import add_mesh, changes, fresh_scene, get_uvs, packing_efficiency, snapshot


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
        with self.assertRaisesRegex(RuntimeError, "Loose.*face 0"):
            bpy.ops.uv.atlas_refine()
        self.assertEqual(self.obj.mode, "EDIT")
        self.leave()
        self.assertEqual(changes(before, snapshot(self.obj)), [])
