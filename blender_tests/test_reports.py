"""What the operators report: of which object, and equal notes in one line."""

import sys
import unittest

import bpy
import numpy as np
import shapes
from support import MODULE, add_mesh, fresh_scene, get_uvs, messages, set_uvs


def add_sheets(names):
    """Small ones, each unwrapped over the whole texture, all selected, the last one active, which comes first."""
    objs = [add_mesh(shapes.join(shapes.grid(2, 2, scale=0.5)), name=name) for name in names]
    for obj in objs:
        obj.select_set(True)
    return objs


def material_with(image):
    material = bpy.data.materials.new("Skin")
    material.use_nodes = True
    material.node_tree.nodes.new("ShaderNodeTexImage").image = image
    return material


class Reports(unittest.TestCase):
    def setUp(self):
        fresh_scene()

    def test_equal_notes_on_objects_are_one(self):
        for obj in add_sheets(["A", "B", "C", "D", "E"]):
            obj.scale = 2, 1, 1
        note = "E, A, B and 2 more: the object's scale is uneven"
        told = messages(bpy.ops.uv.atlas_refine, stacks="SEPARATE")
        self.assertIn(f"Warning: 5 objects: {note}", told)
        self.assertEqual(told.count("uneven"), 1)
        told = messages(bpy.ops.uv.atlas_refine, atlases="OBJECT", pe_bound=0.9)
        self.assertIn(f"Warning: {note}", told)
        self.assertEqual(told.count("uneven"), 1)

    def test_equal_problems_are_one(self):
        add_sheets("AB")
        told = messages(bpy.ops.uv.atlas_refine, atlases="OBJECT", uv_map="Other")
        self.assertIn('Error: B and A: the mesh has no UV map "Other"', told)

    def test_notes_on_a_joint_atlas_name_the_object(self):
        objs = add_sheets(["A", "B", "C"])
        layer = objs[1].data.uv_layers.active
        set_uvs(layer, 0 * get_uvs(layer))
        told = messages(bpy.ops.uv.atlas_refine, stacks="SEPARATE")
        self.assertIn("Warning: 3 objects: 1 chart: has no area in the UV map; left as before, outside the atlas (B)", told)

    def test_an_object_whose_name_begins_the_message_is_named(self):
        add_mesh(name="no")
        told = messages(bpy.ops.uv.atlas_refine, max_distortion=1.0001)
        self.assertIn("Error: no: no atlas within a distortion of 1.0001", told)

    def test_pixels_per_metre_of_0_are_refused(self):
        before = get_uvs(add_mesh().data.uv_layers.active).tobytes()
        settings = bpy.context.scene.atlas_refine
        for value in (0.0, -5.0):
            settings.density, settings.texel_density = "VALUE", value
            told = messages(bpy.ops.uv.atlas_refine_measure)
            told += messages(bpy.ops.uv.atlas_refine, density="VALUE", texel_density=value)
            self.assertEqual(
                told.count(f"Error: Pixels per Metre: it has to be 0.001 at least, not {value:g}"), 4
            )  # each is raised, too
        self.assertEqual(get_uvs(bpy.context.object.data.uv_layers.active).tobytes(), before)
        kind = sys.modules[f"{MODULE}.presets"].option_kinds()["texel_density"]
        with self.assertRaisesRegex(ValueError, "texel_density is from 0.001"):
            kind.checked(0.0)

    def test_a_margin_too_large_for_the_texture_names_both(self):
        add_mesh()
        told = messages(bpy.ops.uv.atlas_refine, texture_size=0)
        self.assertIn("Error: Loose: the margin of 4 px is more than a tenth of the texture of 16 px", told)

    def test_an_attribute_of_another_kind_is_called_so(self):
        obj = add_mesh()
        obj.data.attributes.new("Points", "FLOAT", "POINT")
        obj.data.attributes.new("Colours", "FLOAT_COLOR", "FACE")
        obj.vertex_groups.new(name="Group")
        for option, name, words in (
            ("importance", "Points", '"Points" is a point attribute: a vertex group or a face attribute of numbers is needed'),
            ("keep_shape", "Colours", 'the attribute "Colours" does not hold one number for each face: a vertex group'),
            ("no_seam", "Points", '"Points" is a point attribute: an edge attribute of numbers is needed'),
            ("prefer_seam", "Group", '"Group" is a vertex group: an edge attribute of numbers is needed'),
        ):
            self.assertIn(f"Error: Loose: {words}", messages(bpy.ops.uv.atlas_refine, **{option: name}))

    def test_objects_that_were_unwrapped_by_themselves(self):
        note = "Small has 5 times the texel density of Large, and keeps it: Density: Equal evens them out"
        for scale, options, is_told in (
            (5, {}, True),
            (3, {}, False),
            (5, {"density": "EQUAL"}, False),
            (5, {"atlases": "OBJECT"}, False),
        ):
            fresh_scene()
            small, large = add_sheets(["Small", "Large"])
            large.scale = (scale,) * 3
            for layer in (small.data.uv_layers.active, large.data.uv_layers.active):
                set_uvs(layer, get_uvs(layer) / np.ptp(get_uvs(layer), axis=0))
            told = messages(bpy.ops.uv.atlas_refine, stacks="SEPARATE", **options)
            self.assertEqual(note in told, is_told, told)

    def test_a_margin_that_is_not_of_the_images_pixels(self):
        obj = add_mesh()
        obj.data.materials.append(material_with(bpy.data.images.new("Wide", 2048, 1024)))
        note = "in Wide, 2048 x 1024, the margin of 8 px of 2048 is 8 px across and 4 px up. Aspect: Texture takes its shape"
        for aspect, size, is_told in (
            ("SQUARE", 2048, True),
            ("FREE", 2048, True),
            ("SQUARE", 1024, False),
            ("TEXTURE", 2048, False),
        ):
            told = messages(bpy.ops.uv.atlas_refine, pe_bound=0.7, aspect=aspect, gap_px=8, texture_size=size)
            self.assertEqual(note in told, is_told, told)
