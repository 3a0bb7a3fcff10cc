"""Several objects, shared and linked meshes, materials, UDIM tiles, a copy of the map, vertex groups and attributes."""

import pathlib
import sys
import unittest
import unittest.mock

import bmesh
import bpy
import numpy as np
import shapes
from support import (
    HAS_UV_ATTRIBUTE,
    MODULE,
    add_mesh,
    changes,
    fresh_scene,
    get_uvs,
    messages,
    only_uvs_change,
    packing_efficiency,
    set_uvs,
    snapshot,
    texture_share,
)


def uvs_of(obj):
    return get_uvs(obj.data.uv_layers.active)


def add_two():
    """Both selected, the second active."""
    first, second = add_mesh(name="First"), add_mesh(shapes.arcs(2, 30), name="Second")
    first.select_set(True)
    return first, second


def pin_a_corner(obj, corner):
    if HAS_UV_ATTRIBUTE:  # Blender 4.5 corrupts its heap where setting a pin makes the layer of pins
        obj.data.attributes.new(".pn.UVMap", "BOOLEAN", "CORNER")
    obj.data.uv_layers.active.data[corner].pin_uv = True


class Objects(unittest.TestCase):
    def setUp(self):
        fresh_scene()

    def test_selected_objects_share_one_atlas(self):
        objs = add_two()
        before = [snapshot(obj, but_uvs_of="UVMap") for obj in objs]
        self.assertEqual(bpy.ops.uv.atlas_refine(), {"FINISHED"})
        self.assertGreaterEqual(texture_share(*objs), 0.8)
        for obj, held in zip(objs, before, strict=True):
            self.assertEqual(changes(held, snapshot(obj, but_uvs_of="UVMap")), [])

    def test_or_have_one_each(self):
        objs = add_two()
        with only_uvs_change(*objs):
            self.assertEqual(bpy.ops.uv.atlas_refine(atlases="OBJECT"), {"FINISHED"})
        for obj in objs:
            self.assertGreaterEqual(texture_share(obj), 0.8)

    def test_or_one_for_each_material(self):
        objs = add_two()
        skin, cloth = bpy.data.materials.new("Skin"), bpy.data.materials.new("Cloth")
        for obj in objs:
            obj.data.materials.append(skin)
            obj.data.materials.append(cloth)
        for polygon in objs[0].data.polygons:
            polygon.material_index = polygon.index >= 48
        with only_uvs_change(*objs):
            self.assertEqual(bpy.ops.uv.atlas_refine(atlases="MATERIAL"), {"FINISHED"})
        self.assertGreaterEqual(texture_share(*objs), 1.6)

    def test_each_material_has_the_shape_and_the_margin_of_its_own_image(self):
        objs = add_two()
        sizes = {"Skin": (1024, 256), "Cloth": (256, 512)}
        for name, size in sizes.items():
            material = bpy.data.materials.new(name)
            material.use_nodes = True
            material.node_tree.nodes.new("ShaderNodeTexImage").image = bpy.data.images.new(f"{name} map", *size)
            for obj in objs:
                obj.data.materials.append(material)
        for polygon in objs[0].data.polygons:
            polygon.material_index = polygon.index >= 48
        self.assertNotIn("of another shape", messages(bpy.ops.uv.atlas_refine, atlases="MATERIAL"))
        self.assertGreaterEqual(texture_share(*objs), 1.6)
        first, second = uvs_of(objs[0]).astype(np.float64), uvs_of(objs[1]).astype(np.float64)
        for name, uvs in (("Skin", np.concatenate([first[: 4 * 48], second])), ("Cloth", first[4 * 48 :])):
            pixels = np.minimum(uvs, 1 - uvs) * sizes[name]
            self.assertGreaterEqual(pixels.min(), 4.0)
            self.assertLess(pixels.min(), 4.1)
        bpy.context.scene.atlas_refine.atlases = "MATERIAL"
        told = messages(bpy.ops.uv.atlas_refine_measure)
        self.assertIn("2 objects, Skin: Texture use 8", told)
        self.assertIn("2 objects, Cloth: Texture use 8", told)

    def test_materials_of_one_name_from_two_libraries_are_two(self):
        sizes = ((1024, 512), (512, 1024))
        paths = [str(pathlib.Path(bpy.app.tempdir) / f"skin_{number}.blend") for number in range(len(sizes))]
        for path, size in zip(paths, sizes, strict=True):
            fresh_scene()
            skin = bpy.data.materials.new("Skin")
            skin.use_nodes = True
            skin.node_tree.nodes.new("ShaderNodeTexImage").image = bpy.data.images.new("Map", *size)
            bpy.data.libraries.write(path, {skin})
        fresh_scene()
        objs = add_two()
        for obj, path in zip(objs, paths, strict=True):
            with bpy.data.libraries.load(path, link=True) as (_, there):
                there.materials = ["Skin"]
            obj.data.materials.append(there.materials[0])
        bpy.ops.uv.atlas_refine(atlases="MATERIAL")
        for obj, size in zip(objs, sizes, strict=True):
            self.assertGreaterEqual(texture_share(obj), 0.8)
            uvs = uvs_of(obj).astype(np.float64)
            self.assertAlmostEqual((np.minimum(uvs, 1 - uvs) * size).min(), 4.0, delta=0.1)

    def test_with_one_each_an_object_has_its_own_image(self):
        objs = add_two()
        for obj, size in zip(objs, ((1024, 256), (256, 1024)), strict=True):
            material = bpy.data.materials.new(obj.name)
            material.use_nodes = True
            material.node_tree.nodes.new("ShaderNodeTexImage").image = bpy.data.images.new(obj.name, *size)
            obj.data.materials.append(material)
        self.assertEqual(bpy.ops.uv.atlas_refine(atlases="OBJECT"), {"FINISHED"})
        for obj, size in zip(objs, ((1024, 256), (256, 1024)), strict=True):
            uvs = uvs_of(obj).astype(np.float64)
            pixels = np.minimum(uvs, 1 - uvs) * size
            self.assertGreaterEqual(pixels.min(), 4.0)
            self.assertLess(pixels.min(), 4.1)

    def test_an_object_without_the_uv_map_is_left_out_and_named(self):
        for atlases in ("ALL", "OBJECT", "MATERIAL"):
            with self.subTest(atlases=atlases):
                fresh_scene()
                first, second = add_two()
                first.data.uv_layers.active.name = "Lightmap"
                before = snapshot(second)
                told = messages(bpy.ops.uv.atlas_refine, uv_map="Lightmap", atlases=atlases)
                self.assertIn('Warning: First: left out: Second: the mesh has no UV map "Lightmap"', told)
                self.assertNotIn("Error", told)
                self.assertGreaterEqual(texture_share(first), 0.8)
                self.assertEqual(changes(before, snapshot(second)), [])
        with self.assertRaisesRegex(RuntimeError, 'First: the mesh has no UV map "Other"'):
            bpy.ops.uv.atlas_refine(uv_map="Other")

    def test_several_objects_in_edit_mode(self):
        objs = add_two()
        bpy.ops.object.mode_set(mode="EDIT")
        bpy.ops.mesh.select_all(action="SELECT")
        bpy.ops.uv.select_all(action="SELECT")
        with only_uvs_change(*objs):
            self.assertEqual(bpy.ops.uv.atlas_refine(), {"FINISHED"})
        self.assertEqual([obj.mode for obj in objs], ["EDIT", "EDIT"])
        bpy.ops.object.mode_set(mode="OBJECT")
        self.assertGreaterEqual(texture_share(*objs), 0.8)

    def test_cuts_of_several_objects(self):
        for cut in ("EDGES", "SPLIT"):
            fresh_scene()
            objs = add_two()
            faces = [len(obj.data.polygons) for obj in objs]
            self.assertEqual(bpy.ops.uv.atlas_refine(seams="RECTANGLES", cut=cut), {"FINISHED"})
            self.assertGreaterEqual(texture_share(*objs), 0.8)
            now = [len(obj.data.polygons) for obj in objs]
            self.assertEqual(now == faces, cut == "EDGES")
            for obj in objs:
                self.assertFalse(obj.data.validate())
                self.assertTrue(any(edge.use_seam for edge in obj.data.edges))

    def test_one_without_faces_does_not_disturb(self):
        for mode in ("OBJECT", "EDIT"):
            for options in ({}, {"seams": "RECTANGLES"}, {"seams": "RECTANGLES", "cut": "SPLIT"}):
                with self.subTest(mode=mode, **options):
                    fresh_scene()
                    empty = add_mesh((np.eye(3), np.zeros(1, int), np.zeros(0, int), np.zeros((0, 2))), name="Empty")
                    objs = add_two()
                    empty.select_set(True)
                    bpy.ops.object.mode_set(mode=mode)
                    if mode == "EDIT":
                        bpy.ops.mesh.select_all(action="SELECT")
                        bpy.ops.uv.select_all(action="SELECT")
                    self.assertEqual(bpy.ops.uv.atlas_refine(**options), {"FINISHED"})
                    bpy.ops.object.mode_set(mode="OBJECT")
                    self.assertGreaterEqual(texture_share(*objs), 0.8)
                    self.assertEqual(len(empty.data.vertices), 3)

    def test_a_shared_mesh_is_written_once_and_that_is_told(self):
        obj = add_mesh()
        twin = bpy.data.objects.new("Twin", obj.data)
        bpy.context.collection.objects.link(twin)
        twin.select_set(True)
        with only_uvs_change(obj, twin):
            told = messages(bpy.ops.uv.atlas_refine)
        self.assertIn("2 objects share the mesh", told)
        self.assertEqual(told.count("Texture use"), 1)
        self.assertGreaterEqual(texture_share(twin), 0.8)

    def test_a_shared_mesh_in_edit_mode_elsewhere_is_refused(self):
        obj = add_mesh()
        twin = bpy.data.objects.new("Twin", obj.data)
        bpy.context.collection.objects.link(twin)
        bpy.ops.object.mode_set(mode="EDIT")
        obj.select_set(False)
        twin.select_set(True)
        bpy.context.view_layer.objects.active = twin
        self.assertFalse(bpy.ops.uv.atlas_refine.poll())
        with self.assertRaisesRegex(RuntimeError, "Twin: another object of the same mesh is in edit mode"):
            bpy.ops.uv.atlas_refine()

    def test_linked_meshes_are_refused_with_a_word(self):
        add_mesh(name="Linked")
        path = str(pathlib.Path(bpy.app.tempdir) / "library.blend")
        bpy.ops.wm.save_as_mainfile(filepath=path)
        fresh_scene()
        with bpy.data.libraries.load(path, link=True) as (_, there):
            there.objects = ["Linked"]
        obj = there.objects[0]
        bpy.context.collection.objects.link(obj)
        obj.select_set(True)
        bpy.context.view_layer.objects.active = obj
        with self.assertRaisesRegex(RuntimeError, "Linked: the mesh is linked from a library"):
            bpy.ops.uv.atlas_refine()
        # Beside an object of this file that one is refined all the same.
        own = add_mesh(name="Own")
        obj.select_set(True)
        with only_uvs_change(obj, own):
            told = messages(bpy.ops.uv.atlas_refine)
        self.assertIn("Linked: the mesh is linked from a library", told)
        self.assertGreaterEqual(texture_share(own), 0.8)

    def test_a_failure_of_one_names_it_and_leaves_the_other_done(self):
        first, second = add_two()
        second.data.uv_layers.remove(second.data.uv_layers.active)
        with only_uvs_change(first):
            told = messages(bpy.ops.uv.atlas_refine, atlases="OBJECT")
        self.assertIn("Second: the mesh has no UV map", told)
        self.assertGreaterEqual(texture_share(first), 0.8)

    def test_other_types_of_objects_do_not_disturb(self):
        obj = add_mesh()
        light = bpy.data.objects.new("Light", bpy.data.lights.new("Light", "POINT"))
        bpy.context.collection.objects.link(light)
        light.select_set(True)
        bpy.context.view_layer.objects.active = light
        with only_uvs_change(obj):
            self.assertEqual(bpy.ops.uv.atlas_refine(), {"FINISHED"})
        self.assertGreaterEqual(texture_share(obj), 0.8)


class AllOrNothing(unittest.TestCase):
    """Where one of several objects that share an atlas cannot be written, all are as they were."""

    def setUp(self):
        fresh_scene()
        self.objs = add_two()
        for obj in self.objs:
            obj.data.uv_layers.new(name="Other", do_init=True)  # which becomes the active one

    def check(self, module, function, fails_at, **options):
        """`function` of a module of the bridge fails at one of its calls."""
        module = sys.modules[f"{MODULE}.bridge.{module}"]
        original, calls = getattr(module, function), []

        def failing(*arguments):
            calls.append(arguments)
            if len(calls) == fails_at:
                raise sys.modules[f"{MODULE}.bridge.mesh"].MeshError("as the test has it")
            return original(*arguments)

        before = [snapshot(obj) for obj in self.objs]
        with unittest.mock.patch.object(module, function, failing), self.assertRaisesRegex(RuntimeError, "as the test has it"):
            bpy.ops.uv.atlas_refine(uv_map="UVMap", **options)
        for obj, held in zip(self.objs, before, strict=True):
            self.assertEqual(changes(held, snapshot(obj)), [])
        self.assertEqual(bpy.ops.uv.atlas_refine(uv_map="UVMap", **options), {"FINISHED"})
        for obj, held in zip(self.objs, before, strict=True):
            self.assertNotEqual(changes(held, snapshot(obj)), [])

    def test_where_only_uvs_are_written(self):
        self.check("mesh", "write_in_steps", 2)

    def test_with_copies(self):
        self.check("mesh", "write_in_steps", 2, write_to="COPY")

    def test_with_cuts_along_edges(self):
        self.check("mesh", "write_in_steps", 2, seams="RECTANGLES")

    def test_with_cuts_across_faces(self):
        self.check("cuts", "divide_in_steps", 2, seams="RECTANGLES", cut="SPLIT")

    def test_with_cuts_across_faces_and_copies(self):
        self.check("cuts", "divide_in_steps", 2, seams="RECTANGLES", cut="SPLIT", write_to="COPY")

    def test_with_cuts_across_faces_in_edit_mode(self):
        """The UVs of the first are half written by then."""
        bpy.ops.object.mode_set(mode="EDIT")
        bpy.ops.mesh.select_all(action="SELECT")
        where, calls = sys.modules[f"{MODULE}.bridge.cuts"], []
        original = where.write_edit_mesh

        def failing(*arguments):
            yield from original(*arguments)
            calls.append(arguments)
            if len(calls) == 2:
                raise sys.modules[f"{MODULE}.bridge.mesh"].MeshError("as the test has it")

        bpy.ops.object.mode_set(mode="OBJECT")
        before = [snapshot(obj) for obj in self.objs]
        bpy.ops.object.mode_set(mode="EDIT")
        with unittest.mock.patch.object(where, "write_edit_mesh", failing), self.assertRaisesRegex(RuntimeError, "as the test"):
            bpy.ops.uv.atlas_refine(uv_map="UVMap", seams="RECTANGLES", cut="SPLIT")
        bpy.ops.object.mode_set(mode="OBJECT")
        self.assertEqual([changes(held, snapshot(obj)) for obj, held in zip(self.objs, before, strict=True)], [[], []])

    def test_where_one_has_no_room_for_a_copy(self):
        for k in range(6):
            self.objs[0].data.uv_layers.new(name=str(k))
        before = [snapshot(obj) for obj in self.objs]
        for options in ({}, {"seams": "RECTANGLES", "cut": "SPLIT"}):
            with self.assertRaisesRegex(RuntimeError, "the mesh has no room for another UV map"):
                bpy.ops.uv.atlas_refine(write_to="COPY", uv_map="UVMap", **options)
            self.assertEqual([changes(held, snapshot(obj)) for obj, held in zip(self.objs, before, strict=True)], [[], []])

    def test_in_edit_mode(self):
        for options in ({"write_to": "COPY"}, {"write_to": "COPY", "seams": "RECTANGLES", "cut": "SPLIT"}):
            with self.subTest(**options):
                self.setUp()
                for k in range(6):
                    self.objs[0].data.uv_layers.new(name=str(k))
                bpy.ops.object.mode_set(mode="EDIT")
                bpy.ops.mesh.select_all(action="SELECT")
                bpy.ops.uv.select_all(action="SELECT")
                bpy.ops.object.mode_set(mode="OBJECT")
                before = [snapshot(obj) for obj in self.objs]
                bpy.ops.object.mode_set(mode="EDIT")
                with self.assertRaisesRegex(RuntimeError, "the mesh has no room for another UV map"):
                    bpy.ops.uv.atlas_refine(uv_map="UVMap", **options)
                bpy.ops.object.mode_set(mode="OBJECT")
                self.assertEqual([changes(held, snapshot(obj)) for obj, held in zip(self.objs, before, strict=True)], [[], []])


class Stacks(unittest.TestCase):
    """Three charts of one shape on each other, and another."""

    def setUp(self):
        fresh_scene()
        charts = [shapes.grid(6, 3, scale=0.1, bend=1.2) for _ in range(3)]
        self.obj = add_mesh(shapes.join(*charts, shapes.grid(4, 4, scale=0.1, origin=(0.0, 0.5), bend=0.7)))

    def charts(self):
        return uvs_of(self.obj)[: 3 * 72].reshape(3, 72, 2)

    def test_charts_on_each_other_stay_so_and_that_is_told(self):
        with only_uvs_change(self.obj):
            told = messages(bpy.ops.uv.atlas_refine)
        self.assertIn("2 charts: on another chart of the same shape, kept there", told)
        first, *others = self.charts()
        for other in others:
            self.assertLess(np.abs(other - first).max(), 1e-6)

    def test_or_get_places_of_their_own(self):
        with only_uvs_change(self.obj):
            self.assertEqual(bpy.ops.uv.atlas_refine(stacks="SEPARATE"), {"FINISHED"})
        self.assertGreaterEqual(texture_share(self.obj), 0.8)
        self.assertEqual(bpy.ops.uv.atlas_refine_select_problems(kinds={"OVERLAPPING"}), {"FINISHED"})
        bpy.ops.object.mode_set(mode="OBJECT")
        self.assertFalse(any(polygon.select for polygon in self.obj.data.polygons))


class Tiles(unittest.TestCase):
    def setUp(self):
        fresh_scene()
        charts = [
            shapes.grid(6, 3, scale=0.1, origin=(0.1, 0.1), bend=1.2),
            shapes.grid(4, 4, scale=0.1, origin=(1.3, 0.2), bend=0.7),
        ]
        self.obj = add_mesh(shapes.join(*charts))
        self.before = uvs_of(self.obj)

    def tiled_image(self, active):
        image = bpy.data.images.new("Skin", 256, 256, tiled=True)
        image.tiles.new(1002)
        image.tiles.active_index = active
        material = bpy.data.materials.new("Skin")
        material.use_nodes = True
        material.node_tree.nodes.new("ShaderNodeTexImage").image = image
        self.obj.data.materials.append(material)

    def assert_within(self, uvs, corner):
        """Of the tile's lower left corner; the margin keeps off its border."""
        self.assertTrue(np.all((uvs > corner) & (uvs < np.add(corner, 1))))

    def test_with_a_tiled_image_charts_stay_in_their_tiles(self):
        self.tiled_image(0)
        with only_uvs_change(self.obj):
            self.assertEqual(bpy.ops.uv.atlas_refine(pe_bound=0.7), {"FINISHED"})
        uvs = uvs_of(self.obj)
        self.assert_within(uvs[:72], (0, 0))
        self.assert_within(uvs[72:], (1, 0))

    def test_a_tile_that_the_image_lacks_is_told(self):
        self.tiled_image(0)
        self.assertNotIn("has no tile", messages(bpy.ops.uv.atlas_refine, pe_bound=0.7))
        set_uvs(self.obj.data.uv_layers.active, self.before + (np.arange(len(self.before)) >= 72)[:, None] * [0.0, 1.0])
        told = messages(bpy.ops.uv.atlas_refine, pe_bound=0.7)
        self.assertIn("Warning: Loose: Skin has no tile 1012, in which 16 faces lie and are packed: add it, or move them", told)
        self.assert_within(uvs_of(self.obj)[72:], (1, 1))

    def test_or_only_the_active_one_changes(self):
        self.tiled_image(1)
        with only_uvs_change(self.obj):
            self.assertEqual(bpy.ops.uv.atlas_refine(pe_bound=0.7, tiles="ACTIVE"), {"FINISHED"})
        uvs = uvs_of(self.obj)
        self.assertEqual(uvs[:72].tobytes(), self.before[:72].tobytes())
        self.assert_within(uvs[72:], (1, 0))

    def test_without_one_all_go_to_the_first(self):
        with only_uvs_change(self.obj):
            self.assertEqual(bpy.ops.uv.atlas_refine(pe_bound=0.7), {"FINISHED"})
        self.assertLess(uvs_of(self.obj).max(), 1)

    def test_measure_tells_of_each_tile(self):
        self.tiled_image(0)
        told = messages(bpy.ops.uv.atlas_refine_measure)
        self.assertIn("Loose, 1001: Texture use 9 %", told)
        self.assertIn("Loose, 1002: Texture use 10 %", told)

    def test_unless_each_is_to_keep_its_own(self):
        with only_uvs_change(self.obj):
            self.assertEqual(bpy.ops.uv.atlas_refine(pe_bound=0.7, tiles="EACH"), {"FINISHED"})
        self.assertGreater(uvs_of(self.obj)[72:, 0].min(), 1)


class StacksOfSeveralObjects(unittest.TestCase):
    """Two objects whose charts lie on each other, as each was unwrapped by itself."""

    def setUp(self):
        fresh_scene()
        self.objs = [add_mesh(name="First"), add_mesh(name="Second")]
        self.objs[0].select_set(True)
        for obj in self.objs:
            obj.data.materials.append(bpy.data.materials.get("Skin") or bpy.data.materials.new("Skin"))

    def refine(self, **options):
        """True where the charts of both still lie on each other; else none does."""
        before = [snapshot(obj, but_uvs_of="UVMap") for obj in self.objs]
        self.assertEqual(bpy.ops.uv.atlas_refine(**options), {"FINISHED"})
        for obj, held in zip(self.objs, before, strict=True):
            self.assertEqual(changes(held, snapshot(obj, but_uvs_of="UVMap")), [])
        share = texture_share(*self.objs)
        is_stack = bool(np.allclose(uvs_of(self.objs[0]), uvs_of(self.objs[1]), atol=1e-5))
        self.assertGreaterEqual(share, 1.6 if is_stack else 0.8)
        if not is_stack:
            self.assertLess(share, 1.0)
        return is_stack

    def test_charts_of_one_material_stay_on_each_other(self):
        self.assertTrue(self.refine())

    def test_those_of_different_materials_show_different_textures(self):
        self.objs[1].data.materials[0] = bpy.data.materials.new("Cloth")
        self.assertFalse(self.refine())

    def test_one_density_is_that_of_objects_of_another_scale_too(self):
        self.objs[1].scale = (2.0, 2.0, 2.0)
        bpy.context.view_layer.update()
        self.assertTrue(self.refine(density="KEEP"))
        for obj in self.objs:
            set_uvs(obj.data.uv_layers.active, shapes.loose()[3])
        self.assertFalse(self.refine(density="EQUAL"))
        areas = [
            packing_efficiency(obj.data, obj.data.uv_layers.active) * np.prod(np.ptp(uvs_of(obj), axis=0)) for obj in self.objs
        ]
        self.assertAlmostEqual(areas[1] / areas[0], 4.0, delta=0.2)


class Names(unittest.TestCase):
    """What is told by a name: maps, groups, attributes."""

    def setUp(self):
        fresh_scene()
        self.obj = add_mesh()

    def test_a_copy_of_the_map(self):
        for mode in ("OBJECT", "EDIT"):
            obj = add_mesh(name=mode)
            before = get_uvs(obj.data.uv_layers["UVMap"]).tobytes()
            bpy.ops.object.mode_set(mode=mode)
            if mode == "EDIT":
                bpy.ops.mesh.select_all(action="SELECT")
                bpy.ops.uv.select_all(action="SELECT")
            self.assertEqual(bpy.ops.uv.atlas_refine(write_to="COPY"), {"FINISHED"})
            bpy.ops.object.mode_set(mode="OBJECT")
            self.assertEqual(get_uvs(obj.data.uv_layers["UVMap"]).tobytes(), before)
            self.assertEqual(obj.data.uv_layers.active.name, "UVMap refined")
            self.assertGreaterEqual(texture_share(obj), 0.8)

    def test_a_copy_of_a_map_that_is_cut(self):
        self.assertEqual(bpy.ops.uv.atlas_refine(write_to="COPY", seams="RECTANGLES", cut="SPLIT"), {"FINISHED"})
        self.assertEqual([layer.name for layer in self.obj.data.uv_layers], ["UVMap", "UVMap refined"])
        self.assertGreaterEqual(texture_share(self.obj), 0.8)

    def test_no_room_for_a_copy_leaves_the_mesh_alone(self):
        for k in range(7):
            self.obj.data.uv_layers.new(name=str(k))
        self.obj.data.uv_layers.active = self.obj.data.uv_layers["3"]
        before = snapshot(self.obj)
        engine = sys.modules[f"{MODULE}.engine"]
        no_run = unittest.mock.patch.object(engine, "start", side_effect=AssertionError("it is refused before the run"))
        with no_run, self.assertRaisesRegex(RuntimeError, "Loose: the mesh has no room for another UV map"):
            bpy.ops.uv.atlas_refine(write_to="COPY", uv_map="UVMap")
        self.assertEqual(bpy.ops.uv.atlas_refine_measure(), {"FINISHED"})
        self.assertEqual(changes(before, snapshot(self.obj)), [])

    def test_shapes_are_kept_by_a_vertex_group_and_by_a_face_attribute(self):
        group = self.obj.vertex_groups.new(name="Rigid")
        group.add(list(self.obj.data.polygons[60].vertices), 1.0, "REPLACE")
        part = self.obj.data.attributes.new("Part", "INT", "FACE")
        part.data[60].value = 1
        before = get_uvs(self.obj.data.uv_layers.active)
        for name in ("Rigid", "Part"):
            for mode in ("OBJECT", "EDIT"):
                set_uvs(self.obj.data.uv_layers.active, before)
                bpy.ops.object.mode_set(mode=mode)
                if mode == "EDIT":
                    bpy.ops.mesh.select_all(action="SELECT")
                    bpy.ops.uv.select_all(action="SELECT")
                self.assertEqual(bpy.ops.uv.atlas_refine(keep_shape=name, density="EQUAL"), {"FINISHED"})
                bpy.ops.object.mode_set(mode="OBJECT")
                after = get_uvs(self.obj.data.uv_layers.active)
                kept = slice(4 * 48, 4 * 84)
                self.assertLess(self.bending(before[kept], after[kept]), 1e-4)
                self.assertGreater(self.bending(before[:192], after[:192]), 1e-3)

    @staticmethod
    def bending(before, after):
        """How far lengths of edges differ from one factor."""
        lengths = [np.linalg.norm(uvs[1::4] - uvs[::4], axis=1) for uvs in (before, after)]
        factors = lengths[1] / lengths[0]
        return np.ptp(factors) / factors.mean()

    def test_edges_of_an_attribute_are_no_seams(self):
        bpy.ops.uv.atlas_refine(seams="RECTANGLES", density="EQUAL")
        cut = [edge.index for edge in self.obj.data.edges if edge.use_seam]
        self.assertTrue(cut)
        for mode in ("OBJECT", "EDIT"):
            self.obj = add_mesh(name=mode)
            self.obj.data.attributes.new("Whole", "INT", "EDGE")
            for index in cut:
                self.obj.data.attributes["Whole"].data[index].value = 1
            bpy.ops.object.mode_set(mode=mode)
            if mode == "EDIT":
                bpy.ops.mesh.select_all(action="SELECT")
                bpy.ops.uv.select_all(action="SELECT")
            bpy.ops.uv.atlas_refine(seams="RECTANGLES", density="EQUAL", no_seam="Whole", best_effort=True)
            bpy.ops.object.mode_set(mode="OBJECT")
            self.assertFalse([index for index in cut if self.obj.data.edges[index].use_seam])

    def test_seams_are_marked_or_not(self):
        bpy.ops.uv.atlas_refine(seams="RECTANGLES", mark_seams=False)
        self.assertFalse(any(edge.use_seam for edge in self.obj.data.edges))

    def test_the_names_that_the_panel_offers_are_of_what_is_read(self):
        self.obj.vertex_groups.new(name="Rigid")
        for name, kind, domain in (
            ("Face", "FLOAT", "FACE"),
            ("Edge", "BOOLEAN", "EDGE"),
            ("Vertex", "FLOAT", "POINT"),
            ("Word", "STRING", "EDGE"),
        ):
            self.obj.data.attributes.new(name, kind, domain)
        named = sys.modules[f"{MODULE}.bridge.named"]
        faces, edges = named.names_of_faces(self.obj), named.names_of_edges(self.obj)
        self.assertLessEqual({"Rigid", "Face"}, set(faces))
        self.assertIn("Edge", edges)
        self.assertFalse({"Vertex", "Word", "UVMap"} & {*faces, *edges})

    def test_a_name_that_nothing_has_is_refused(self):
        before = snapshot(self.obj)
        for option in ("keep_shape", "importance", "no_seam", "prefer_seam"):
            with self.assertRaisesRegex(RuntimeError, 'there is no .* "Nothing"'):
                bpy.ops.uv.atlas_refine(**{option: "Nothing"})
        self.assertEqual(changes(before, snapshot(self.obj)), [])

    def test_importance_from_a_vertex_group(self):
        group = self.obj.vertex_groups.new(name="Face")
        group.add(list(range(10)), 1.0, "REPLACE")
        self.assertEqual(bpy.ops.uv.atlas_refine(importance="Face"), {"FINISHED"})
        plain = add_mesh(name="Plain")
        bpy.ops.uv.atlas_refine()
        self.assertNotEqual(uvs_of(self.obj).tobytes(), uvs_of(plain).tobytes())


class Broken(unittest.TestCase):
    """One bad chart never refuses the mesh, and Select Problems finds it."""

    def setUp(self):
        fresh_scene()
        self.obj = add_mesh()

    @property
    def layer(self):
        return self.obj.data.uv_layers.active

    def selected(self):
        bpy.ops.object.mode_set(mode="OBJECT")
        return [polygon.index for polygon in self.obj.data.polygons if polygon.select]

    def change(self, function, faces):
        uvs = get_uvs(self.layer)
        corners = slice(4 * faces.start, 4 * faces.stop)
        uvs[corners] = function(uvs[corners])
        set_uvs(self.layer, uvs)

    def test_a_chart_without_area_is_left_and_counted(self):
        self.change(lambda uvs: 0 * uvs + 0.5, range(84, 102))
        told = messages(bpy.ops.uv.atlas_refine)
        self.assertIn("Loose: 1 chart: has no area in the UV map", told)
        self.assertNotIn("chart 2", told)
        self.assertEqual(bpy.ops.uv.atlas_refine_select_problems(), {"FINISHED"})
        self.assertEqual(self.selected(), list(range(84, 102)))

    def test_a_flipped_chart_is_mended_and_told(self):
        self.change(lambda uvs: uvs * [-1, 1], range(48))
        told = messages(bpy.ops.uv.atlas_refine)
        self.assertIn("Loose: 1 chart: mirrored, turned over", told)
        self.assertGreaterEqual(texture_share(self.obj), 0.8)

    def test_each_kind_is_found(self):
        self.change(lambda uvs: uvs * [-1, 1], range(48))
        bpy.ops.uv.atlas_refine_select_problems(kinds={"MIRRORED"})
        self.assertEqual(self.selected(), list(range(48)))
        bpy.ops.uv.atlas_refine_select_problems()
        self.assertEqual(self.selected(), [])
        uvs = get_uvs(self.layer)
        uvs[4 * 84 :] = uvs[4 * 84 :] * 0.01 + uvs[4 * 48 : 4 * 49].mean(axis=0) - 0.01 * uvs[4 * 84 :].mean(axis=0)
        set_uvs(self.layer, uvs)
        bpy.ops.uv.atlas_refine_select_problems(kinds={"OVERLAPPING"})
        self.assertEqual(self.selected(), [48, *range(84, 102)])

    def test_charts_that_the_last_run_left_are_found_while_that_is_true(self):
        self.change(lambda uvs: 0 * uvs + 0.5, range(84, 102))
        bpy.ops.uv.atlas_refine()
        bpy.ops.uv.atlas_refine_select_problems(kinds={"LEFT"})
        self.assertEqual(self.selected(), list(range(84, 102)))
        self.change(lambda uvs: 0.5 * uvs, range(48))
        self.obj.data.update()
        bpy.context.view_layer.update()
        bpy.ops.uv.atlas_refine_select_problems(kinds={"LEFT"})
        self.assertEqual(self.selected(), [])

    def test_non_manifold_faces_are_found(self):
        bpy.ops.mesh.primitive_plane_add()
        self.obj = bpy.context.object
        mesh = bmesh.new()
        mesh.from_mesh(self.obj.data)
        verts = list(mesh.verts)
        edge = mesh.edges.get((verts[0], verts[1])) or mesh.edges[0]
        for z in (1.0, -1.0):
            top = mesh.verts.new((0.0, -2.0, z))
            mesh.faces.new((*edge.verts, top))
        mesh.to_mesh(self.obj.data)
        mesh.free()
        told = messages(bpy.ops.uv.atlas_refine_select_problems, kinds={"NON_MANIFOLD"})
        self.assertIn("3 faces non-manifold", told)
        self.assertEqual(self.selected(), [0, 1, 2])

    def test_the_counts_are_told(self):
        self.change(lambda uvs: 0 * uvs + 0.5, range(84, 102))
        told = messages(bpy.ops.uv.atlas_refine_select_problems)
        self.assertIn("Loose: 18 faces not unwrapped", told)
        bpy.ops.object.mode_set(mode="OBJECT")
        self.assertIn("no problems", messages(self.on_a_clean_mesh))

    def test_what_is_hidden_is_not_selected_and_told_as_such(self):
        self.change(lambda uvs: 0 * uvs + 0.5, range(84, 102))
        for face in range(90, 102):
            self.obj.data.polygons[face].hide = True
        told = messages(bpy.ops.uv.atlas_refine_select_problems)
        self.assertIn("Loose: 6 faces not unwrapped, 12 hidden faces not unwrapped", told)
        self.assertEqual(self.selected(), list(range(84, 90)))
        for polygon in self.obj.data.polygons:
            polygon.hide = True
        told = messages(bpy.ops.uv.atlas_refine_select_problems)
        self.assertIn("Loose: 18 hidden faces not unwrapped", told)
        self.assertEqual(self.selected(), [])

    def on_a_clean_mesh(self):
        add_mesh(name="Clean")
        return bpy.ops.uv.atlas_refine_select_problems()


class LastResult(unittest.TestCase):
    """What the panel shows is cleared when it is no longer true."""

    def setUp(self):
        fresh_scene()
        self.obj = add_mesh()

    @staticmethod
    def shown():
        bpy.context.view_layer.update()
        return sys.modules[f"{MODULE}.tasks"].last_if_true()

    def test_it_stays_while_nothing_changes(self):
        bpy.ops.uv.atlas_refine()
        self.assertEqual(self.shown()[0].title, "Loose")
        self.obj.location.x += 1
        bpy.ops.object.mode_set(mode="EDIT")
        self.assertIsNotNone(self.shown())
        bpy.ops.object.mode_set(mode="OBJECT")
        self.assertIsNotNone(self.shown())

    def test_it_goes_with_the_uvs_the_mesh_the_object_and_the_file(self):
        def move_a_uv():
            set_uvs(self.obj.data.uv_layers.active, get_uvs(self.obj.data.uv_layers.active) * 0.5)
            self.obj.data.update()

        def move_a_vertex():
            self.obj.data.vertices[0].co.x += 1
            self.obj.data.update()

        for change in (move_a_uv, move_a_vertex, lambda: bpy.data.objects.remove(self.obj), fresh_scene):
            self.obj = add_mesh()
            bpy.ops.uv.atlas_refine()
            self.assertIsNotNone(self.shown())
            change()
            self.assertIsNone(self.shown())

    def test_measure_cuts_nothing_and_asks_for_no_more(self):
        bpy.context.scene.atlas_refine.seams = "RECTANGLES"
        bpy.context.scene.atlas_refine.cut = "SPLIT"
        self.obj.modifiers.new("Detail", "MULTIRES")
        self.obj.data.polygons.foreach_set("hide", np.arange(102) < 48)
        self.assertIn("2 charts", messages(bpy.ops.uv.atlas_refine_measure))
        with self.assertRaisesRegex(RuntimeError, "Multiresolution"):
            bpy.ops.uv.atlas_refine(seams="RECTANGLES", cut="SPLIT")

    def test_measure_names_the_box_that_a_run_would_have(self):
        bpy.context.scene.atlas_refine.aspect = "FREE"
        uvs = uvs_of(self.obj)
        set_uvs(self.obj.data.uv_layers.active, (uvs - uvs.min(axis=0)) / 40)
        free = packing_efficiency(self.obj.data, self.obj.data.uv_layers.active)
        self.assertIn(f"Loose: Box use {100 * free:.0f} %", messages(bpy.ops.uv.atlas_refine_measure))
        pin_a_corner(self.obj, 350)
        share = texture_share(self.obj)
        self.assertNotEqual(round(100 * share), round(100 * free))
        self.assertIn(f"Loose: Texture use {100 * share:.0f} %", messages(bpy.ops.uv.atlas_refine_measure))

    def test_measure_looks_at_what_would_stay_too(self):
        for item in range(len(self.obj.data.loops)):
            pin_a_corner(self.obj, item) if item == 0 else setattr(self.obj.data.uv_layers.active.data[item], "pin_uv", True)
        self.assertIn("3 charts", messages(bpy.ops.uv.atlas_refine_measure))
        bpy.ops.object.mode_set(mode="EDIT")
        bpy.ops.mesh.select_all(action="DESELECT")
        self.assertIn("3 charts", messages(bpy.ops.uv.atlas_refine_measure))

    def test_measure_leaves_out_what_a_refinement_leaves_out_and_tells_it(self):
        """Charts that are hidden as a whole, but not those that are hidden in part."""
        self.assertNotIn("left out", messages(bpy.ops.uv.atlas_refine_measure))
        self.obj.data.polygons.foreach_set("hide", np.arange(102) < 49)
        self.assertIn("48 hidden faces left out", messages(bpy.ops.uv.atlas_refine_measure))
        measures = self.shown()[0].measures
        bpy.ops.uv.atlas_refine()
        before = self.shown()[0].result.before
        self.assertEqual(measures.chart_count, before.chart_count)
        self.assertAlmostEqual(measures.pe_fixed_aspect, before.pe_fixed_aspect)
        self.assertAlmostEqual(measures.distortion, before.distortion)

    def test_measure_says_of_a_result_what_the_result_said(self):
        """Of faces that are far from flat: how they are divided makes the difference."""
        bpy.ops.mesh.primitive_monkey_add()
        self.obj = bpy.context.object
        bpy.ops.object.mode_set(mode="EDIT")
        bpy.ops.mesh.select_all(action="SELECT")
        bpy.ops.uv.smart_project()
        bpy.ops.object.mode_set(mode="OBJECT")
        bpy.ops.uv.atlas_refine()
        after = self.shown()[0].result.after
        bpy.ops.uv.atlas_refine_measure()
        measures = self.shown()[0].measures
        self.assertAlmostEqual(measures.stretch_max, after.stretch_max)
        self.assertAlmostEqual(measures.distortion, after.distortion)

    def test_measure_shows_figures_and_changes_nothing(self):
        before = snapshot(self.obj)
        told = messages(bpy.ops.uv.atlas_refine_measure)
        self.assertIn("Info: Loose: Texture use 95 % (reaching beyond it), distortion high", told)
        self.assertIn("3 charts", told)
        self.assertEqual(changes(before, snapshot(self.obj)), [])
        self.assertIsNotNone(self.shown()[0].measures)
