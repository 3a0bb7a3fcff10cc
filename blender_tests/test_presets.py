"""Presets: built in, the user's own and a studio's, from the panel and by name in scripts."""

import pathlib
import sys
import tempfile
import unittest

import bpy
from support import MODULE, add_mesh, changes, fresh_scene, messages, snapshot

NAMES = ["Game Texture", "Film UDIM Tile", "Lightmap", "Mobile", "Paper Defaults"]


def presets():
    return sys.modules[f"{MODULE}.presets"]


def own_folder():
    return pathlib.Path(bpy.utils.user_resource("SCRIPTS", path="presets/operator/uv.atlas_refine", create=True))


class Presets(unittest.TestCase):
    def setUp(self):
        fresh_scene()
        self.preferences = bpy.context.preferences.addons[MODULE].preferences
        self.settings = bpy.context.scene.atlas_refine

    def write_own(self, name, text):
        path = own_folder() / f"{name}.py"
        path.write_text(text)
        self.addCleanup(path.unlink, missing_ok=True)

    def assert_refused(self, operator, *words, **options):
        with self.assertRaises(RuntimeError) as caught:
            operator(**options)
        for word in words:
            self.assertIn(word, str(caught.exception))
        self.assertNotIn("Traceback", str(caught.exception))

    def test_every_built_in_preset_refines(self):
        for name in NAMES:
            with self.subTest(name):
                add_mesh()
                self.assertEqual(bpy.ops.uv.atlas_refine(preset=name), {"FINISHED"})

    def test_every_built_in_preset_fits_the_operator_and_the_panel(self):
        kinds = presets().option_kinds()
        for name in NAMES:
            for option, value in presets().values_of(name).items():
                self.assertEqual(kinds[option].checked(value), value)
            self.assertEqual(bpy.ops.uv.atlas_refine_load_preset(name=name), {"FINISHED"})
            for option, value in presets().values_of(name).items():
                held = getattr(self.settings, option)
                self.assertEqual(round(held, 6) if isinstance(held, float) else held, value)

    def test_a_preset_by_name_is_what_its_options_are(self):
        results = []
        for options in ({"preset": "Mobile"}, presets().values_of("Mobile"), {}):
            obj = add_mesh()
            bpy.ops.uv.atlas_refine(**options)
            results.append(snapshot(obj))
        self.assertEqual(changes(results[0], results[1]), [])
        self.assertNotEqual(changes(results[0], results[2]), [])

    def test_what_is_given_wins_over_the_preset(self):
        add_mesh()
        self.assertIn("-> 82 %", messages(bpy.ops.uv.atlas_refine, preset="Mobile", pe_bound=0.82))

    def test_an_unknown_name_lists_those_there_are(self):
        obj = add_mesh()
        before = snapshot(obj)
        self.assert_refused(bpy.ops.uv.atlas_refine, 'no preset "Gane"', *NAMES, preset="Gane")
        self.assert_refused(bpy.ops.uv.atlas_refine_load_preset, 'no preset "Gane"', *NAMES, name="Gane")
        self.assertEqual(changes(before, snapshot(obj)), [])

    def test_a_broken_file_is_told_and_changes_nothing(self):
        obj = add_mesh()
        before = snapshot(obj)
        for text, reason in (
            ("op.pe_bound = (", "not Python"),
            ("op.nothing = 1", "nothing"),
            ("op.seams = 'X'", "NONE, NEEDED, RECTANGLES"),
        ):
            self.write_own("broken", text)
            self.assert_refused(bpy.ops.uv.atlas_refine, '"Broken" is broken', reason, preset="broken")
            self.assert_refused(bpy.ops.uv.atlas_refine_load_preset, '"Broken" is broken', reason, name="Broken")
        self.assertEqual(changes(before, snapshot(obj)), [])

    def test_ones_own_preset_is_kept_loaded_and_removed(self):
        self.settings.pe_bound = 0.65
        self.settings.aspect = "SQUARE"
        self.assertEqual(bpy.ops.uv.atlas_refine_add_preset(name="Hero Prop"), {"FINISHED"})
        self.assertEqual(bpy.ops.uv.atlas_refine_load_preset(name="Game Texture"), {"FINISHED"})
        self.assertEqual(self.settings.aspect, "TEXTURE")
        self.assertEqual(bpy.ops.uv.atlas_refine_load_preset(name="Hero Prop"), {"FINISHED"})
        self.assertEqual(self.settings.aspect, "SQUARE")
        self.assertAlmostEqual(self.settings.pe_bound, 0.65)
        (own,) = [preset for preset in presets().all_presets() if preset.source == "own"]
        bpy.ops.uv.atlas_refine_add_preset(name=own.path.stem, remove_name=True)
        self.assertFalse(own.path.exists())
        self.assert_refused(bpy.ops.uv.atlas_refine_load_preset, 'no preset "Hero Prop"', name="Hero Prop")

    def test_presets_that_blender_kept_of_the_operator_are_ones_own(self):
        bpy.ops.uv.atlas_refine_add_preset(name="Probe")
        self.addCleanup(bpy.ops.uv.atlas_refine_add_preset, name="Probe", remove_name=True)
        paths = bpy.utils.preset_paths("operator/uv.atlas_refine")
        self.assertIn(own_folder().resolve(), [pathlib.Path(path).resolve() for path in paths])

    def test_a_studios_folder_is_read_and_never_written(self):
        self.addCleanup(setattr, self.preferences, "studio_presets", "")
        with tempfile.TemporaryDirectory() as folder:
            pathlib.Path(folder, "house_style.py").write_text("op.pe_bound = 0.55\nop.aspect = 'SQUARE'\n")
            self.preferences.studio_presets = folder
            bpy.ops.uv.atlas_refine_load_preset(name="House Style")
            self.assertAlmostEqual(self.settings.pe_bound, 0.55)
            add_mesh()
            self.assertEqual(bpy.ops.uv.atlas_refine(preset="House Style"), {"FINISHED"})
            bpy.ops.uv.atlas_refine_add_preset(name="House Style")
            self.addCleanup(bpy.ops.uv.atlas_refine_add_preset, name="House_Style", remove_name=True)
            self.assertEqual([path.name for path in pathlib.Path(folder).iterdir()], ["house_style.py"])
        self.assertEqual(len([preset for preset in presets().all_presets() if preset.source == "studio"]), 0)

    def test_preferences_are_defaults_and_threads(self):
        for name, value in (("gap_px", 9.0), ("texture_size", 512), ("threads", 2)):
            self.addCleanup(setattr, self.preferences, name, getattr(self.preferences, name))
            setattr(self.preferences, name, value)
        self.assertEqual((self.settings.gap_px, self.settings.texture_size), (9.0, 512))
        tasks = sys.modules[f"{MODULE}.tasks"]
        add_mesh()
        run = tasks.Run(bpy.context, sys.modules[f"{MODULE}.properties"].to_options(self.settings))
        self.addCleanup(run.stop)
        self.assertEqual(run._threads, 2)
