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
        self.assertEqual(properties["gap"].default, "PIXELS")
        self.assertEqual(properties["aspect"].default, "TEXTURE")
        self.assertIn("stays empty", properties["aspect"].enum_items["FREE"].description)
        self.assertEqual([item.identifier for item in properties["seams"].enum_items], ["NONE", "NEEDED", "RECTANGLES"])
        self.assertEqual(properties["seams"].default, "NONE")
        self.assertAlmostEqual(properties["sigma"].default, 0.004)
        for panel, space in ((bpy.types.IMAGE_PT_atlas_refine, "IMAGE_EDITOR"), (bpy.types.VIEW3D_PT_atlas_refine, "VIEW_3D")):
            self.assertEqual((panel.bl_space_type, panel.bl_region_type, panel.bl_category), (space, "UI", "Atlas Refine"))
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

    def test_every_option_has_a_tooltip_without_a_full_stop(self):
        ours = bpy.ops.uv
        for operator in (
            ours.atlas_refine,
            ours.atlas_refine_again,
            ours.atlas_refine_keep_best,
            ours.atlas_refine_measure,
            ours.atlas_refine_trade_off,
            ours.atlas_refine_select_problems,
            ours.atlas_refine_load_preset,
        ):
            kind = operator.get_rna_type()
            texts = [(kind.name, kind.description)]
            for option in kind.properties:
                if option.identifier == "rna_type":
                    continue
                texts.append((option.identifier, option.description))
                if option.type == "ENUM":
                    texts += [(item.identifier, item.description) for item in option.enum_items]
            for name, text in texts:
                self.assertTrue(text and not text.endswith("."), (name, text))

    def test_the_menus_of_both_editors_have_it(self):
        def ours(menu):
            functions = getattr(bpy.types, menu).draw._draw_funcs
            return [function for function in functions if function.__module__ == f"{MODULE}.panels"]

        for menu in ("IMAGE_MT_uvs", "VIEW3D_MT_uv_map"):
            self.assertEqual(len(ours(menu)), 1)
            addon_utils.disable(MODULE, default_set=True)
            self.assertEqual(ours(menu), [])
            enable_addon()

    def test_disabled_and_enabled_again(self):
        for _ in range(2):
            addon_utils.disable(MODULE, default_set=True)
            self.assertFalse(hasattr(bpy.types, "IMAGE_PT_atlas_refine"))
            self.assertFalse(hasattr(bpy.types.Scene, "atlas_refine"))
            enable_addon()
            self.assertTrue(hasattr(bpy.types, "IMAGE_PT_atlas_refine"))
