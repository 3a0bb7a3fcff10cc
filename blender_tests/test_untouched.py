"""Only the UVs of one map change: everything else a mesh can hold is compared byte for byte."""

import unittest

import bpy
import numpy as np
from support import HAS_UV_ATTRIBUTE, add_mesh, changes, fresh_scene, get_uvs, set_uvs, snapshot


def add_everything(obj):
    """Other UV maps, pins, vertex groups, colours, custom normals, shape keys, seams, materials, attributes, properties."""
    mesh = obj.data
    if HAS_UV_ATTRIBUTE:  # Blender 4.5 corrupts its heap where setting a pin makes the layer of pins
        mesh.attributes.new(".pn.UVMap", "BOOLEAN", "CORNER")
    for index, corner in enumerate(mesh.uv_layers.active.data):
        corner.pin_uv = index in (340, 345, 350)  # of the third chart, which stays
    other = mesh.uv_layers.new(name="Lightmap")
    set_uvs(other, get_uvs(mesh.uv_layers[0])[::-1] * 0.25)
    mesh.uv_layers.active_index = 0

    for name, factor in (("Spine", 0.5), ("Arm", 0.125)):
        group = obj.vertex_groups.new(name=name)
        for vertex in range(0, len(mesh.vertices), 3):
            group.add([vertex], factor, "REPLACE")
    random = np.random.default_rng(5)
    for name, domain, kind in (("Paint", "CORNER", "BYTE_COLOR"), ("Mask", "POINT", "FLOAT_COLOR")):
        colours = mesh.color_attributes.new(name, kind, domain)
        colours.data.foreach_set("color", random.random(4 * len(colours.data)).astype(np.float32))
    weight = mesh.attributes.new("wear", "FLOAT", "POINT")
    weight.data.foreach_set("value", random.random(len(mesh.vertices)).astype(np.float32))

    for name in ("Skin", "Cloth"):
        mesh.materials.append(bpy.data.materials.new(name))
    for polygon in mesh.polygons:
        polygon.material_index = polygon.index % 2
        polygon.use_smooth = True
        polygon.select = polygon.index % 5 == 0
    for edge in mesh.edges:
        edge.use_seam = edge.index % 7 == 0
        edge.use_edge_sharp = edge.index % 11 == 0
    mesh["asset"] = "hero"

    if hasattr(mesh, "use_auto_smooth"):  # before 4.1
        mesh.use_auto_smooth = True
    tilt = random.normal(size=(len(mesh.loops), 3)) * 0.2 + [0.0, 0.0, 1.0]
    mesh.normals_split_custom_set((tilt / np.linalg.norm(tilt, axis=1, keepdims=True)).tolist())

    obj.shape_key_add(name="Basis")
    smile = obj.shape_key_add(name="Smile")
    for index in range(0, len(smile.data), 2):
        smile.data[index].co.z += 0.5
    smile.value = 0.25
    obj.modifiers.new("Subdivision", "SUBSURF")
    obj.location.x = 3.0


class Untouched(unittest.TestCase):
    def setUp(self):
        fresh_scene()

    def check(self, obj, run):
        before = snapshot(obj, but_uvs_of="UVMap")
        uvs = get_uvs(obj.data.uv_layers["UVMap"])
        self.assertEqual(run(), {"FINISHED"})
        self.assertEqual(changes(before, snapshot(obj, but_uvs_of="UVMap")), [])
        self.assertFalse(np.array_equal(get_uvs(obj.data.uv_layers["UVMap"]), uvs))

    def test_in_object_mode(self):
        obj = add_mesh()
        add_everything(obj)
        self.check(obj, lambda: bpy.ops.uv.atlas_refine(pe_bound=0.5))

    def test_in_edit_mode(self):
        obj = add_mesh()
        add_everything(obj)
        # Edit mode alone may rewrite some of it (custom normals are packed anew): compare after one visit.
        bpy.ops.object.mode_set(mode="EDIT")
        bpy.ops.object.mode_set(mode="OBJECT")

        def run():
            bpy.ops.object.mode_set(mode="EDIT")
            try:
                return bpy.ops.uv.atlas_refine(pe_bound=0.5)
            finally:
                bpy.ops.object.mode_set(mode="OBJECT")

        self.check(obj, run)

    def test_objects_that_are_not_selected_are_not_touched(self):
        other = add_mesh(name="Other")
        before = snapshot(other)
        add_mesh(name="Mine")
        bpy.ops.uv.atlas_refine()
        self.assertEqual(changes(before, snapshot(other)), [])
