"""What the operator does where nothing is said: the box is the texture's, the margin is in its pixels and holds to its border too."""

import unittest

import bpy
import numpy as np
import shapes
from support import add_mesh, fresh_scene, get_uvs, messages, set_uvs, texture_share


def add_image(obj, width, height):
    """As the image of the active material's texture node."""
    image = bpy.data.images.new("Skin", width, height)
    material = bpy.data.materials.new("Skin")
    material.use_nodes = True
    material.node_tree.nodes.new("ShaderNodeTexImage").image = image
    obj.data.materials.append(material)
    return image


def border_in_pixels(uvs, width, height):
    uvs = uvs.astype(np.float64)
    return min((uvs * [width, height]).min(), ((1 - uvs) * [width, height]).min())


class Defaults(unittest.TestCase):
    def setUp(self):
        fresh_scene()

    def test_the_texture_is_square_where_no_image_tells(self):
        obj = add_mesh()
        self.assertEqual(bpy.ops.uv.atlas_refine(), {"FINISHED"})
        uvs = get_uvs(obj.data.uv_layers.active)
        self.assertGreaterEqual(texture_share(obj), 0.8)
        self.assertGreaterEqual(border_in_pixels(uvs, 2048, 2048), 4.0)

    def test_the_shape_and_the_size_are_those_of_the_materials_image(self):
        obj = add_mesh()
        add_image(obj, 1024, 256)
        self.assertEqual(bpy.ops.uv.atlas_refine(), {"FINISHED"})
        uvs = get_uvs(obj.data.uv_layers.active)
        self.assertGreaterEqual(texture_share(obj), 0.8)
        self.assertGreaterEqual(border_in_pixels(uvs, 1024, 256), 4.0)
        self.assertLess(border_in_pixels(uvs, 1024, 256), 4.1)

    def test_the_image_that_is_used_counts_and_those_in_groups(self):
        obj = add_mesh()
        add_image(obj, 256, 1024)
        tree = obj.active_material.node_tree
        group = bpy.data.node_groups.new("Group", "ShaderNodeTree")
        image = group.nodes.new("ShaderNodeTexImage")
        image.image = bpy.data.images.new("Used", 1024, 256)
        mix = group.nodes.new("ShaderNodeMixRGB")
        group.links.new(image.outputs[0], mix.inputs[1])
        tree.nodes.new("ShaderNodeGroup").node_tree = group
        tree.nodes.active = None
        bpy.ops.uv.atlas_refine()
        uvs = get_uvs(obj.data.uv_layers.active)
        self.assertGreaterEqual(border_in_pixels(uvs, 1024, 256), 4.0)
        self.assertLess(border_in_pixels(uvs, 1024, 256), 4.1)

    def test_images_of_other_shapes_are_told(self):
        obj = add_mesh()
        for name, size in (("Skin", (512, 512)), ("Eyes", (256, 256)), ("Hair", (512, 128)), ("Unused", (128, 512))):
            add_image(obj, *size).name = name
        numbers = np.arange(len(obj.data.polygons), dtype=np.int32) % 3
        obj.data.polygons.foreach_set("material_index", numbers)
        told = messages(bpy.ops.uv.atlas_refine)
        self.assertIn("Warning: Loose: packed for Skin; of another shape: Hair. By Material each has its own", told)
        numbers[:] = np.minimum(numbers, 1)
        obj.data.polygons.foreach_set("material_index", numbers)
        told = messages(bpy.ops.uv.atlas_refine, pe_bound=0.7)
        self.assertNotIn("packed for", told)
        note = "Warning: Loose: Skin and Eyes share one atlas, so each is used in part only. By Material each has its own"
        self.assertIn(note, told)
        self.assertNotIn("share one atlas", messages(bpy.ops.uv.atlas_refine, pe_bound=0.65, atlases="MATERIAL"))
        numbers[:] = 0
        obj.data.polygons.foreach_set("material_index", numbers)
        self.assertNotIn("share one atlas", messages(bpy.ops.uv.atlas_refine, pe_bound=0.6))

    def test_square_goes_by_the_texture_size(self):
        obj = add_mesh()
        add_image(obj, 1024, 256)
        bpy.ops.uv.atlas_refine(aspect="SQUARE", texture_size=512)
        self.assertGreaterEqual(border_in_pixels(get_uvs(obj.data.uv_layers.active), 512, 512), 4.0)

    def test_a_map_that_fills_its_own_box_but_not_the_texture_is_enlarged(self):
        obj = add_mesh()
        bpy.ops.uv.atlas_refine(gap="AUTO")
        layer = obj.data.uv_layers.active
        set_uvs(layer, 0.5 * get_uvs(layer))
        bpy.ops.uv.atlas_refine(gap="AUTO")
        self.assertGreaterEqual(texture_share(obj), 0.8)

    def test_a_second_run_changes_nothing(self):
        obj = add_mesh()
        bpy.ops.uv.atlas_refine()
        before = get_uvs(obj.data.uv_layers.active).tobytes()
        self.assertEqual(bpy.ops.uv.atlas_refine(), {"FINISHED"})
        self.assertEqual(get_uvs(obj.data.uv_layers.active).tobytes(), before)

    def test_equal_densities_are_made_where_the_use_is_there_already(self):
        """With all of them kept nothing changes."""
        sizes = (0.06, 0.054)
        charts = [shapes.grid(8, 8, scale=size, origin=(0.01 + 0.5 * k, 0.01)) for k, size in enumerate(sizes)]
        obj = add_mesh(shapes.join(*charts))
        layer = obj.data.uv_layers.active
        before = get_uvs(layer)
        bpy.ops.uv.atlas_refine(pe_bound=0.4)
        self.assertEqual(get_uvs(layer).tobytes(), before.tobytes())
        bpy.ops.uv.atlas_refine(pe_bound=0.4, density="EQUAL")
        first, second = (np.ptp(corners, axis=0).prod() for corners in np.split(get_uvs(layer), 2))
        self.assertAlmostEqual(first / second, 1.0, delta=0.02)
        self.assertGreaterEqual(texture_share(obj), 0.4)
        after = get_uvs(layer).tobytes()
        bpy.ops.uv.atlas_refine(pe_bound=0.4, density="EQUAL")
        self.assertEqual(get_uvs(layer).tobytes(), after)

    def test_the_report_is_in_words(self):
        obj = add_mesh()
        told = messages(bpy.ops.uv.atlas_refine)
        self.assertIn("Info: Loose: Texture use 95 % (reaching beyond it) -> 80 %, distortion moderate (worst stretch 1.", told)
        layer = obj.data.uv_layers.active
        set_uvs(layer, 0.5 * get_uvs(layer))
        told = messages(bpy.ops.uv.atlas_refine)
        self.assertIn("Info: Loose: Texture use 20 % -> 80 %, distortion", told)
        self.assertIn("no new seams", told)
        for symbol in ("PE", "E_d", "BL"):
            self.assertNotIn(symbol, told)
