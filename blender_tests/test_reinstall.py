"""Another version installed over the one that runs: nothing crashes, and the new one is what runs from then on."""

import pathlib
import re
import subprocess
import sys
import tempfile
import unittest
import zipfile

import addon_utils
import bpy
import shapes
from support import LEGACY, MODULE, add_mesh, enable_addon, fresh_scene, get_uvs

(ARCHIVE,) = (pathlib.Path(__file__).resolve().parents[1] / "dist").glob("atlas_refine-*.zip")


def install(archive):
    """As from the preferences' button, over what is there."""
    if LEGACY:
        bpy.ops.preferences.addon_install(filepath=str(archive), overwrite=True)
    else:
        bpy.ops.extensions.package_install_files(
            filepath=str(archive), repo="user_default", enable_on_install=True, overwrite=True
        )


def module(name):
    return sys.modules[f"{MODULE}.{name}"]


class Reinstall(unittest.TestCase):
    def setUp(self):
        fresh_scene()
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.other = pathlib.Path(folder.name) / "other.zip"

    def make_other(self):
        """The same with another engine folder and another word."""
        with zipfile.ZipFile(ARCHIVE) as source, zipfile.ZipFile(self.other, "w") as target:
            for entry in source.infolist():
                data = source.read(entry)
                if entry.filename.endswith("native/__init__.py"):
                    data = re.sub(rb"atlas_refine_\w+", b"atlas_refine_other", data)
                if entry.filename.endswith("core/words.py"):
                    data = data.replace(b'"bending"', b'"pressing"')
                entry.filename = re.sub(r"native/atlas_refine_\w+", "native/atlas_refine_other", entry.filename)
                target.writestr(entry, data)

    def put_back(self):
        install(ARCHIVE)
        enable_addon()

    def test_the_new_version_is_what_runs(self):
        self.make_other()
        self.assertEqual(module("core.words").phase("squeeze"), "bending")
        self.addCleanup(self.put_back)
        install(self.other)
        addon_utils.disable(MODULE, default_set=True)
        enable_addon()
        self.assertEqual(module("core.words").phase("squeeze"), "pressing")
        self.assertIn("atlas_refine_other", module("engine").module.__file__)
        self.assertEqual(module("panels").phase("squeeze"), "pressing")
        add_mesh()
        self.assertEqual(bpy.ops.uv.atlas_refine(), {"FINISHED"})

    def test_nothing_has_to_be_unticked_for_the_new_version(self):
        self.make_other()
        look = module("reinstalled").load_what_is_installed
        self.assertEqual(look(), module("reinstalled").PERIOD_SECONDS)
        self.addCleanup(self.put_back)
        tasks = module("tasks")
        install(self.other)
        if LEGACY:  # else Blender has loaded it. Without a window there are no timers, whose work this is
            tasks.running = "a refinement"
            self.assertIsNotNone(look())
            tasks.running = None
            look()
        self.assertEqual(module("core.words").phase("squeeze"), "pressing")
        self.assertTrue(bpy.app.timers.is_registered(module("reinstalled").load_what_is_installed))
        add_mesh()
        self.assertEqual(bpy.ops.uv.atlas_refine(), {"FINISHED"})

    def test_the_old_version_goes_on_while_the_new_one_is_written(self):
        self.make_other()
        obj = add_mesh(shapes.loose())
        before = get_uvs(obj.data.uv_layers.active).tobytes()
        options = module("core.options").Options(seams="RECTANGLES", candidates=100000, threads=1)
        run = module("tasks").Run(bpy.context, options)
        self.addCleanup(self.put_back)
        install(self.other)
        self.assertFalse(run.wait(0.2))
        run.stop()
        self.assertTrue(run.cancelled)
        self.assertEqual(get_uvs(obj.data.uv_layers.active).tobytes(), before)

    def test_a_wrong_python_is_this_addons_own_trouble(self):
        """The engine's module is not there, as it is under a Python that has none."""
        self.make_other()
        with zipfile.ZipFile(self.other) as source:
            entries = [(entry, source.read(entry)) for entry in source.infolist() if not entry.filename.endswith(".so")]
        with zipfile.ZipFile(self.other, "w") as target:
            for entry, data in entries:
                target.writestr(entry, data)
        self.addCleanup(self.put_back)
        addon_utils.disable(MODULE, default_set=True)
        told = []
        if LEGACY:
            install(self.other)
        else:
            with self.assertRaisesRegex(RuntimeError, "engine does not load on Python"):
                install(self.other)
        self.assertIsNone(addon_utils.enable(MODULE, handle_error=told.append))
        self.assertNotIn(MODULE, [name for name in sys.modules if name == MODULE])
        for error in told:
            self.assertIsInstance(error, ImportError)
            self.assertEqual(error.name, MODULE)
            self.assertIn("engine does not load on Python 3.", str(error))
        self.assertEqual(bpy.ops.mesh.primitive_cube_add(), {"FINISHED"})


@unittest.skipIf(LEGACY, "Blender knows extensions from 4.2 on")
class Validation(unittest.TestCase):
    def test_blenders_own_validation_passes(self):
        """What `blender --command extension validate` runs, which the bpy module has no command line for."""
        program = pathlib.Path(addon_utils.__file__).parents[1] / "addons_core" / "bl_pkg" / "cli" / "blender_ext.py"
        done = subprocess.run([sys.executable, program, "validate", ARCHIVE], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
