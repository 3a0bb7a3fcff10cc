"""The add-on as it was installed from the zip: what it registers, and that it leaves nothing behind."""

import os
import pathlib
import sys
import unittest

import addon_utils
import bpy
from support import LEGACY, MODULE, enable_addon, fresh_scene


class Registration(unittest.TestCase):
    def setUp(self):
        fresh_scene()

    def test_it_was_installed_into_this_profile(self):
        module = sys.modules[MODULE]
        folder = "addons" if LEGACY else "extensions"
        profile = pathlib.Path(os.environ["BLENDER_USER_RESOURCES"]).resolve()
        self.assertIn(profile, pathlib.Path(module.__file__).resolve().parents)
        self.assertIn(folder, pathlib.Path(module.__file__).parts)

    def test_it_brings_its_engine_and_leaves_the_search_path_alone(self):
        folder = pathlib.Path(sys.modules[MODULE].__file__).parent
        self.assertFalse([entry for entry in sys.path if pathlib.Path(entry) == folder or folder in pathlib.Path(entry).parents])
        self.assertNotIn("atlas_refine", sys.modules)
        self.assertTrue((folder / "LICENSE").is_file())

    def test_operator_panel_settings_and_preferences_are_there(self):
        properties = bpy.ops.uv.atlas_refine.get_rna_type().properties
        self.assertAlmostEqual(properties["pe_bound"].default, 0.8)
        self.assertEqual(properties["density"].default, "KEEP")
        self.assertEqual(properties["gap"].default, "AUTO")
        self.assertEqual([item.identifier for item in properties["seams"].enum_items], ["NONE", "RECTANGLES"])
        self.assertEqual(properties["seams"].default, "NONE")
        self.assertAlmostEqual(properties["sigma"].default, 0.004)
        panel = bpy.types.IMAGE_PT_atlas_refine
        self.assertEqual((panel.bl_space_type, panel.bl_region_type, panel.bl_category), ("IMAGE_EDITOR", "UI", "Atlas Refine"))
        self.assertEqual(bpy.context.scene.atlas_refine.density, "KEEP")

    def test_preferences_are_the_defaults_of_new_scenes(self):
        preferences = bpy.context.preferences.addons[MODULE].preferences
        self.addCleanup(setattr, preferences, "pe_bound", preferences.pe_bound)
        bpy.context.scene.atlas_refine.pe_bound = 0.7
        preferences.pe_bound = 0.9
        self.assertAlmostEqual(bpy.context.scene.atlas_refine.pe_bound, 0.7)
        self.assertAlmostEqual(bpy.data.scenes.new("Another").atlas_refine.pe_bound, 0.9)
        self.addCleanup(setattr, preferences, "seams", preferences.seams)
        self.assertEqual(bpy.context.scene.atlas_refine.seams, "NONE")
        preferences.seams = "RECTANGLES"
        self.assertEqual(bpy.context.scene.atlas_refine.seams, "RECTANGLES")
        bpy.context.scene.atlas_refine.seams = "NONE"
        self.assertEqual(bpy.context.scene.atlas_refine.seams, "NONE")

    def test_a_scene_keeps_its_settings_in_the_file(self):
        bpy.context.scene.atlas_refine.pe_bound = 0.65
        bpy.context.scene.atlas_refine.aspect = "SQUARE"
        bpy.context.scene.atlas_refine.seams = "RECTANGLES"
        bpy.context.scene.atlas_refine.sigma = 0.01
        path = pathlib.Path(bpy.app.tempdir) / "settings.blend"
        bpy.ops.wm.save_as_mainfile(filepath=str(path))
        bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
        bpy.ops.wm.open_mainfile(filepath=str(path))
        self.assertAlmostEqual(bpy.context.scene.atlas_refine.pe_bound, 0.65)
        self.assertEqual(bpy.context.scene.atlas_refine.aspect, "SQUARE")
        self.assertEqual(bpy.context.scene.atlas_refine.seams, "RECTANGLES")
        self.assertAlmostEqual(bpy.context.scene.atlas_refine.sigma, 0.01)

    def test_disabled_and_enabled_again(self):
        for _ in range(2):
            addon_utils.disable(MODULE, default_set=True)
            self.assertFalse(hasattr(bpy.types, "IMAGE_PT_atlas_refine"))
            self.assertFalse(hasattr(bpy.types.Scene, "atlas_refine"))
            enable_addon()
            self.assertTrue(hasattr(bpy.types, "IMAGE_PT_atlas_refine"))
