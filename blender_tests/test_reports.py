"""What the operators report: of which object, and equal notes in one line."""

import sys
import unittest

import bpy
import shapes
from support import MODULE, add_mesh, fresh_scene, get_uvs, messages, set_uvs


def add_sheets(names):
    """Small ones, each unwrapped over the whole texture, all selected, the last one active, which comes first."""
    objs = [add_mesh(shapes.join(shapes.grid(2, 2, scale=0.5)), name=name) for name in names]
    for obj in objs:
        obj.select_set(True)
    return objs


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
