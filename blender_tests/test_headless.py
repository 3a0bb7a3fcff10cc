"""Many .blend files without a window: what is written, what is skipped, and how it ends."""

import contextlib
import gzip
import io
import json
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time
import unittest

import addon_utils
import bpy
import numpy as np
import shapes
from support import MODULE, add_mesh, changes, fresh_scene, packing_efficiency, set_uvs, snapshot

#: Blender 3.4's importer asks for a name that its NumPy on Debian 12 no longer has.
GLTF_IS_BROKEN = bpy.app.version < (3, 6, 0) and not hasattr(np, "bool")
ROOT = pathlib.Path(__file__).resolve().parents[1]


def script_command(*arguments):
    """A new Blender that runs the script of the installed add-on."""
    script = pathlib.Path(sys.modules[MODULE].__file__).with_name("atlas_refine_headless.py")
    if bpy.app.binary_path:
        return [bpy.app.binary_path, "-b", "--factory-startup", "--python", str(script), "--", *arguments]
    return [sys.executable, str(script), "--", *arguments]


class Headless(unittest.TestCase):
    def setUp(self):
        fresh_scene()
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name).resolve()

    def make(self, name, **options):
        """A .blend file with three loose charts."""
        bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
        add_mesh()
        path = self.folder / name
        path.parent.mkdir(exist_ok=True)
        bpy.ops.wm.save_as_mainfile(filepath=str(path), **options)
        return path

    def run_it(self, *arguments):
        """(exit code, stdout, stderr)."""
        out, err = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            code = sys.modules[f"{MODULE}.headless"].main(list(map(str, arguments)))
        return code, out.getvalue(), err.getvalue()

    def record(self, path):
        return json.loads(path.with_name(f"{path.stem}.atlas_refine.json").read_text())

    def names(self, folder="."):
        return sorted(path.name for path in (self.folder / folder).iterdir())

    def use_in(self, path):
        bpy.ops.wm.open_mainfile(filepath=str(path))
        mesh = bpy.data.objects["Loose"].data
        return packing_efficiency(mesh, mesh.uv_layers.active)

    def test_results_and_records_go_to_the_folder(self):
        source = self.make("a.blend")
        before = source.read_bytes()
        code, out, err = self.run_it(source, "-o", self.folder / "out")
        self.assertEqual((code, err), (0, ""))
        self.assertIn("Loose: Texture use", out)
        self.assertEqual(source.read_bytes(), before)
        self.assertEqual(self.names("out"), ["a.atlas_refine.json", "a.blend"])
        self.assertGreaterEqual(self.use_in(self.folder / "out/a.blend"), 0.8)

    def test_the_record_has_the_words_of_the_report(self):
        self.run_it(self.make("a.blend"), "-o", self.folder / "out", "--pe-bound", "0.75", "--seed", "3")
        record = self.record(self.folder / "out/a.blend")
        self.assertEqual((record["program"], record["status"], record["problems"]), ("atlas-refine", "done", []))
        self.assertEqual((record["options"]["pe_bound"], record["options"]["seed"]), (0.75, 3))
        (atlas,) = record["atlases"]
        schema = json.loads((ROOT / "docs" / "report.schema.json").read_text())
        self.assertLessEqual(set(atlas) - {"name", "notes"}, set(schema["properties"]))
        for when in ("before", "after"):
            self.assertEqual(set(atlas[when]), set(schema["$defs"]["measures"]["properties"]))
        self.assertGreaterEqual(atlas["after"]["pe_fixed_aspect"], 0.75)
        self.assertEqual((atlas["added_seam_edges"], atlas["boundary_growth"]), (0, 0.0))

    def test_only_the_uv_map_differs(self):
        source = self.make("a.blend")
        bpy.ops.wm.open_mainfile(filepath=str(source))
        obj = bpy.data.objects["Loose"]
        obj.select_set(False)
        before, active = snapshot(obj, but_uvs_of="UVMap"), bpy.context.view_layer.objects.active.name
        bpy.ops.wm.save_as_mainfile(filepath=str(source))
        self.assertEqual(self.run_it(source, "--in-place")[0], 0)
        bpy.ops.wm.open_mainfile(filepath=str(source))
        obj = bpy.data.objects["Loose"]
        self.assertEqual(changes(before, snapshot(obj, but_uvs_of="UVMap")), [])
        self.assertFalse(obj.select_get())
        self.assertEqual(bpy.context.view_layer.objects.active.name, active)

    def test_what_is_done_is_not_done_again(self):
        source = self.make("a.blend")
        for where in (["-o", self.folder / "out"], ["--in-place"]):
            output = source if where == ["--in-place"] else self.folder / "out/a.blend"
            self.assertNotIn("done already", self.run_it(source, *where)[1])
            written = output.stat().st_mtime_ns
            code, out, _ = self.run_it(source, *where, "--threads", "1")
            self.assertEqual((code, output.stat().st_mtime_ns), (0, written))
            self.assertIn("done already", out)
            self.assertNotIn("done already", self.run_it(source, *where, "--again")[1])
            self.assertNotIn("done already", self.run_it(source, *where, "--pe-bound", "0.85")[1])
            self.assertNotIn("done already", self.run_it(source, *where, "--object", "Loose")[1])
            self.assertGreaterEqual(self.use_in(output), 0.8)

    def test_a_file_that_changed_is_done_anew(self):
        source = self.make("a.blend")
        self.run_it(source, "-o", self.folder / "out")
        bpy.ops.wm.open_mainfile(filepath=str(source))
        bpy.data.objects["Loose"].name = "Renamed"
        bpy.ops.wm.save_as_mainfile(filepath=str(source))
        self.assertIn("Renamed", self.run_it(source, "-o", self.folder / "out")[1])

    def test_patterns_and_shards(self):
        sources = [self.make(f"{name}.blend") for name in "abc"]
        pattern = self.folder / "**" / "*.blend"
        done = []
        for shard in ("1/2", "2/2"):
            code, out, _ = self.run_it(pattern, "-o", self.folder / "out", "--shard", shard)
            self.assertEqual(code, 0)
            done += [source.name for source in sources if str(source) in out]
        self.assertEqual(done, ["a.blend", "c.blend", "b.blend"])
        self.assertEqual(self.run_it(pattern, "-o", self.folder / "out")[1].count("done already"), 3)

    def exported(self, name):
        """The three loose charts as a file of another kind."""
        bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
        add_mesh()
        path = self.folder / name
        if path.suffix == ".obj":
            bpy.ops.wm.obj_export(filepath=str(path))
            return path
        addon_utils.enable("io_scene_gltf2" if path.suffix != ".fbx" else "io_scene_fbx")
        if path.suffix == ".fbx":
            bpy.ops.export_scene.fbx(filepath=str(path))
        else:
            bpy.ops.export_scene.gltf(filepath=str(path), export_format="GLB" if path.suffix == ".glb" else "GLTF_SEPARATE")
        return path

    def test_files_of_other_kinds_become_blend_files(self):
        for name in ("a.obj", "b.glb", "c.gltf", "d.fbx"):
            with self.subTest(name):
                source = self.exported(name)
                before = source.read_bytes()
                code, out, err = self.run_it(source, "-o", self.folder / "out")
                if source.suffix in {".glb", ".gltf"} and GLTF_IS_BROKEN:
                    (told,) = (line for line in err.splitlines() if line.startswith("atlas_refine: "))  # the importer tells more
                    self.assertIn("importer failed: AttributeError: module 'numpy'", told)
                    self.assertEqual(code, 3)
                    continue
                self.assertEqual((code, err), (0, ""))
                self.assertIn("Texture use", out)
                self.assertEqual(source.read_bytes(), before)
                output = self.folder / "out" / f"{source.stem}.blend"
                bpy.ops.wm.open_mainfile(filepath=str(output))
                (obj,) = [obj for obj in bpy.data.objects if obj.type == "MESH"]
                self.assertGreaterEqual(packing_efficiency(obj.data, obj.data.uv_layers.active), 0.8)
                self.assertEqual(self.record(output)["input"], str(source))
                self.assertIn("done already", self.run_it(source, "-o", self.folder / "out")[1])

    def test_a_buffer_of_a_gltf_that_changed_is_done_anew(self):
        source = self.exported("c.gltf")
        self.run_it(source, "-o", self.folder / "out")
        (buffer,) = self.folder.glob("*.bin")
        buffer.write_bytes(buffer.read_bytes() + bytes(4))
        self.assertNotIn("done already", self.run_it(source, "-o", self.folder / "out")[1])

    def test_broken_files_of_other_kinds_are_told(self):
        for name in ("a.obj", "b.glb", "c.gltf", "d.fbx"):
            (self.folder / name).write_bytes(b"nonsense")
        code, _, err = self.run_it(self.folder / "*.*", "-o", self.folder / "out")
        self.assertEqual((code, len(err.splitlines())), (3, 4), err)
        self.assertEqual([self.record(self.folder / f"out/{name}.blend")["status"] for name in "abcd"], ["failed"] * 4)

    def test_a_line_of_the_trade_off(self):
        source = self.make("a.blend")
        asked = [source, "-o", self.folder / "out", "--effort", "fast", "--pe-bound", "0.85"]
        code, _, err = self.run_it(*asked, "--point", "0")
        self.assertEqual((code, err), (2, "atlas_refine: --point is of --seams needed\n"))
        self.assertEqual(self.run_it(*asked, "--seams", "needed", "--point", "0")[0], 0)
        (atlas,) = self.record(self.folder / "out/a.blend")["atlases"]
        self.assertEqual(atlas["cuts"]["chosen"], 0)
        last = len(atlas["cuts"]["trade_off"]) - 1
        self.assertGreater(last, 0)
        self.assertNotIn("done already", self.run_it(*asked, "--seams", "needed", "--point", last)[1])
        self.assertEqual(self.record(self.folder / "out/a.blend")["atlases"][0]["cuts"]["chosen"], last)

    def test_one_bad_file_does_not_stop_the_others(self):
        good = self.make("good.blend")
        (self.folder / "bad.blend").write_bytes(b"BLENDER-nonsense")
        bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
        bpy.ops.wm.save_as_mainfile(filepath=str(self.folder / "empty.blend"))
        bare = self.make("bare.blend")
        obj = bpy.data.objects["Loose"]
        obj.data.uv_layers.remove(obj.data.uv_layers.active)
        bpy.ops.wm.save_as_mainfile(filepath=str(bare))
        code, _, err = self.run_it(self.folder / "*.blend", self.folder / "gone.blend", "-o", self.folder / "out")
        self.assertEqual(code, 3)
        told = err.splitlines()
        self.assertEqual(len(told), 4)
        words = [
            "bad.blend: Blender cannot open it",
            "bare.blend: Loose: the mesh has no UV map",
            "no mesh object",
            "no such file",
        ]
        for line, text in zip(sorted(told), words, strict=True):
            self.assertIn(text, line)
            self.assertTrue(line.startswith("atlas_refine: "))
        self.assertEqual([name for name in self.names("out") if name.endswith(".blend")], [good.name])
        self.assertEqual(self.record(self.folder / "out/bad.blend")["status"], "failed")

    def test_a_folder_is_called_so(self):
        (self.folder / "scenes").mkdir()
        code, _, err = self.run_it(self.folder / "scenes", "-o", self.folder / "out")
        self.assertEqual(
            (code, err), (3, f"atlas_refine: {self.folder}/scenes: it is a folder: name its files, as 'scenes/*.blend'\n")
        )

    def test_a_missing_file_leaves_nothing(self):
        self.assertEqual(self.run_it(self.folder / "no" / "gone.blend", "--in-place")[0], 3)
        self.assertEqual(self.names(), [])

    def test_more_shards_than_files(self):
        self.assertEqual(self.run_it(self.make("a.blend"), "-o", self.folder / "out", "--shard", "2/2"), (0, "", ""))

    def test_a_bound_out_of_reach(self):
        options = ["--pe-bound", "0.999", "--aspect", "free", "--gap-px", "50", "--texture-size", "1024"]
        source = self.make("a.blend")
        code, _, err = self.run_it(source, "-o", self.folder / "out", *options)
        self.assertEqual(code, 4)
        self.assertIn("the best found is texture use", err)
        self.assertEqual(self.names("out"), ["a.atlas_refine.json"])
        code, out, _ = self.run_it(source, "-o", self.folder / "out", *options, "--best-effort")
        self.assertEqual(code, 0)
        (atlas,) = self.record(self.folder / "out/a.blend")["atlases"]
        self.assertFalse(atlas["bound_met"])
        self.assertIn("missed: texture use 99.9 %, reached ", atlas["notes"][0])
        self.assertEqual(out.count(atlas["notes"][0]), 2)  # in the headline, too

    def make_of_two(self, name):
        """A .blend file with two materials: of a square sheet, which fills the texture, and of an arc, which has to bend for it."""
        bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
        arc = add_mesh(shapes.join(shapes.grid(24, 3, bend=5.0)), name="Arc")
        sheet = add_mesh(shapes.join(shapes.grid(4, 4)), name="Sheet")
        for obj in (arc, sheet):
            obj.data.materials.append(bpy.data.materials.new(f"Of {obj.name}"))
        return self.saved(name)

    def saved(self, name):
        path = self.folder / name
        bpy.ops.wm.save_as_mainfile(filepath=str(path))
        return path

    def test_a_material_that_misses_the_bound(self):
        source = self.make_of_two("a.blend")
        asked = [source, "-o", self.folder / "out", "--atlases", "material", "--max-distortion", "1.01"]
        for _ in range(2):  # a second run does it again
            code, out, err = self.run_it(*asked)
            self.assertEqual((code, err.count("\n")), (4, 1), err)
            self.assertIn("a.blend: 2 objects, Of Arc: keeps its UVs: ", err)
            self.assertIn("\n  partly\n  2 objects: 1 of 2 materials reached 80 %; Of Arc keeps its UVs (no atlas within", out)
            record = self.record(self.folder / "out/a.blend")
            self.assertEqual(record["status"], "partly")
            self.assertEqual([problem["object"] for problem in record["problems"]], ["2 objects, Of Arc"])
            self.assertEqual([group["bound_met"] for group in record["atlases"][0]["groups"]], [False, True])
        self.assertEqual(self.names("out"), ["a.atlas_refine.json", "a.blend"])

    def test_a_file_in_which_no_chart_can_be_refined(self):
        bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
        obj = add_mesh()
        set_uvs(obj.data.uv_layers.active, np.zeros((len(obj.data.loops), 2)))
        source = self.saved("a.blend")
        for _ in range(2):
            code, out, err = self.run_it(source, "-o", self.folder / "out")
            self.assertEqual((code, err.count("\n")), (3, 1), err)
            self.assertIn("Loose: no chart can be refined: 3 charts: each has no area in the UV map", err)
            self.assertIn("\n  failed\n", out)
        record = self.record(self.folder / "out/a.blend")
        self.assertEqual((record["status"], record["atlases"]), ("failed", []))
        self.assertEqual(self.names("out"), ["a.atlas_refine.json"])

    def test_presets_and_what_is_given_as_well(self):
        source = self.make("a.blend")
        self.run_it(source, "-o", self.folder / "out", "--preset", "mobile", "--gap-px", "2", "--no-open-closed")
        options = self.record(self.folder / "out/a.blend")["options"]
        self.assertEqual((options["pe_bound"], options["gap_px"], options["open_closed"]), (0.85, 2.0, False))
        code, _, err = self.run_it(source, "--in-place", "--preset", "nobile")
        self.assertEqual(code, 2)
        self.assertIn("there are Game Texture, Film UDIM Tile", err)
        self.assertEqual(self.run_it("--list-presets")[1].splitlines()[0], "Game Texture")

    def test_usage(self):
        source = self.make("a.blend")
        out = ["-o", self.folder / "out"]
        for arguments, words in (
            ([source], "-o DIR and --in-place"),
            ([source, *out, "--in-place"], "-o DIR and --in-place"),
            (out, "no file is named"),
            ([self.folder / "x*.blend", *out], "no file fits"),
            ([source, *out, "--shard", "3/2"], "1 <= I <= N"),
            ([source, *out, "--seams", "some"], "seams is one of NONE, NEEDED, RECTANGLES"),
            ([source, *out, "--pe-bound", "many"], "pe_bound is a number"),
            ([source, *out, "--pe-bound", "1.2"], "texture use"),
            ([source, *out, "--nothing"], "--nothing"),
            ([source, *out, "--selected", "--object", "A"], "exclude each other"),
            ([source, self.make("sub/a.blend"), *out], "would both become"),
        ):
            code, _, err = self.run_it(*arguments)
            self.assertEqual(code, 2, arguments)
            self.assertEqual(err.count("\n"), 1, err)
            self.assertIn(words, err)

    def test_help_names_every_option(self):
        code, out, _ = self.run_it("--help")
        self.assertEqual(code, 0)
        for name in sys.modules[f"{MODULE}.properties"].OPTION_NAMES:
            self.assertIn(f"--{name.replace('_', '-')}", out)

    def test_every_option_is_documented(self):
        documented = (ROOT / "docs" / "headless.md").read_text()
        for name in sys.modules[f"{MODULE}.properties"].OPTION_NAMES:
            self.assertIn(f"`--{name.replace('_', '-')}", documented)

    def test_objects(self):
        source = self.make("a.blend")
        bpy.ops.wm.open_mainfile(filepath=str(source))
        add_mesh(name="Hidden").hide_set(True)
        bpy.data.objects["Loose"].select_set(True)
        bpy.ops.object.camera_add()
        bpy.data.objects["Loose"].select_set(True)
        bpy.ops.wm.save_as_mainfile(filepath=str(source))
        for arguments, title in (
            ([], "2 objects"),
            (["--selected"], "Loose"),
            (["--object", "H*"], "Hidden"),
            (["--object", "Hidden", "--object", "Loose"], "2 objects"),
        ):
            self.run_it(source, "-o", self.folder / "out", *arguments)
            self.assertEqual([atlas["name"] for atlas in self.record(self.folder / "out/a.blend")["atlases"]], [title])
        self.assertEqual(self.run_it(source, "-o", self.folder / "out", "--object", "X")[0], 3)

    def test_paths_in_the_file_and_compression_are_kept(self):
        (self.folder / "in").mkdir()
        image = bpy.data.images.new("Skin", 8, 8)
        image.filepath_raw = str(self.folder / "skin.png")
        image.file_format = "PNG"
        image.save()
        source = self.make("in/a.blend")
        image = bpy.data.images.load(str(self.folder / "skin.png"))
        image.use_fake_user = True
        image.filepath = "//../skin.png"
        bpy.ops.wm.save_as_mainfile(filepath=str(source), compress=True)
        os.chmod(source, 0o640)
        self.run_it(source, "-o", self.folder / "out" / "deeper")
        output = self.folder / "out/deeper/a.blend"
        self.assertNotEqual(output.read_bytes()[:7], b"BLENDER")
        self.assertEqual(output.stat().st_mode & 0o777, 0o640)
        bpy.ops.wm.open_mainfile(filepath=str(output))
        (image,) = [image for image in bpy.data.images if image.source == "FILE"]
        self.assertEqual(pathlib.Path(bpy.path.abspath(image.filepath)).resolve(), self.folder / "skin.png")

    def test_an_old_compressed_file(self):
        source = self.make("a.blend", compress=False)
        source.write_bytes(gzip.compress(source.read_bytes()))
        self.assertEqual(self.run_it(source, "--in-place")[0], 0)
        self.assertGreaterEqual(self.use_in(source), 0.8)

    def test_in_place_leaves_what_holds_the_bound_untouched(self):
        source = self.make("a.blend")
        self.run_it(source, "--in-place")
        before, when = source.read_bytes(), source.stat().st_mtime_ns
        self.assertEqual(self.run_it(source, "--in-place", "--again")[0], 0)
        self.assertEqual((source.read_bytes(), source.stat().st_mtime_ns), (before, when))
        self.assertEqual(self.names(), ["a.atlas_refine.json", "a.blend"])

    def test_an_output_that_cannot_be_written(self):
        source = self.make("a.blend")
        (self.folder / "out").write_text("a file")
        code, _, err = self.run_it(source, "-o", self.folder / "out")
        self.assertEqual(code, 2)
        self.assertIn("out: File exists", err)
        self.assertNotIn("Traceback", err)

    def test_the_script_in_a_blender_of_its_own(self):
        source = self.make("a.blend")
        done = subprocess.run(
            script_command(str(source), "-o", str(self.folder / "out")), capture_output=True, text=True, check=False
        )
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertGreaterEqual(self.use_in(self.folder / "out/a.blend"), 0.8)
        done = subprocess.run(
            script_command(str(self.folder / "gone.blend"), "--in-place"), capture_output=True, text=True, check=False
        )
        self.assertEqual(done.returncode, 3, done.stdout + done.stderr)

    def test_ctrl_c(self):
        source = self.make("a.blend")
        before = source.read_bytes()
        command = script_command(str(source), "--in-place", "--seams", "rectangles", "--candidates", "1000000")
        running = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        for line in running.stdout:
            if line.startswith("[1/1]"):
                break
        time.sleep(2)
        self.assertIsNone(running.poll())
        running.send_signal(signal.SIGINT)
        began = time.monotonic()
        _, err = running.communicate(timeout=60)
        print(f"Ctrl-C ended it in {time.monotonic() - began:.2f} s")
        self.assertEqual(running.returncode, 130, err)
        self.assertIn("atlas_refine: stopped", err)
        self.assertEqual(source.read_bytes(), before)
        self.assertEqual(self.names(), ["a.blend"])
