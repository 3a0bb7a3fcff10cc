"""Selected charts only; pinned and unselected ones stay where they are and others go around them; hidden faces stay."""

import unittest

import bmesh
import bpy
import numpy as np
import shapes
from support import HAS_UV_ATTRIBUTE, add_mesh, changes, fresh_scene, get_uvs, snapshot

#: Faces of arrays(): 12 x 4, 6 x 6, 9 x 2 quads.
FIRST, SECOND, THIRD = range(48), range(48, 84), range(84, 102)
LOW = {"pe_bound": 0.4}


def arrays():
    """shapes.loose(), within the texture and apart."""
    positions, offsets, corners, uvs = shapes.loose()
    return positions, offsets, corners, uvs / 30


def corners_of(faces):
    return [4 * face + k for face in faces for k in range(4)]


def pin(obj, faces):
    mesh = obj.data
    if HAS_UV_ATTRIBUTE:
        mesh.attributes.new(".pn.UVMap", "BOOLEAN", "CORNER")
        for corner in corners_of(faces):
            mesh.attributes[".pn.UVMap"].data[corner].value = True
    else:
        for corner in corners_of(faces):
            mesh.uv_layers.active.data[corner].pin_uv = True


class Selection(unittest.TestCase):
    def setUp(self):
        fresh_scene()
        self.obj = add_mesh(arrays())
        self.before = get_uvs(self.obj.data.uv_layers.active)

    def edit(self, faces=(), uvs=(), hidden=(), sync=False):
        """Edit mode with these faces selected in the mesh, and in the UV editor."""
        bpy.context.scene.tool_settings.use_uv_select_sync = sync
        bpy.ops.object.mode_set(mode="EDIT")
        bpy.ops.mesh.select_mode(type="FACE")
        bpy.ops.mesh.select_all(action="DESELECT")
        mesh = bmesh.from_edit_mesh(self.obj.data)
        layer = mesh.loops.layers.uv.active
        for index, face in enumerate(mesh.faces):
            face.select_set(index in faces)
            for loop in face.loops:
                if hasattr(loop, "uv_select_vert"):
                    loop.uv_select_vert = index in uvs
                else:
                    loop[layer].select = index in uvs
            if index in hidden:
                face.hide_set(True)
        mesh.select_flush_mode()
        bmesh.update_edit_mesh(self.obj.data)

    def changed_faces(self):
        if self.obj.mode == "EDIT":
            bpy.ops.object.mode_set(mode="OBJECT")
        moved = np.any(get_uvs(self.obj.data.uv_layers.active) != self.before, axis=1).reshape(-1, 4)
        self.assertTrue(np.all(moved.any(axis=1) == moved.all(axis=1)))
        return np.flatnonzero(moved.any(axis=1)).tolist()

    def refine(self, **options):
        """Only UVs may change, whatever is selected."""
        mode = self.obj.mode
        bpy.ops.object.mode_set(mode="OBJECT")
        before = snapshot(self.obj, but_uvs_of="UVMap")
        bpy.ops.object.mode_set(mode=mode)
        self.assertEqual(bpy.ops.uv.atlas_refine(**{**LOW, **options}), {"FINISHED"})
        self.assertEqual(self.obj.mode, mode)
        bpy.ops.object.mode_set(mode="OBJECT")
        self.assertEqual(changes(before, snapshot(self.obj, but_uvs_of="UVMap")), [])

    def assert_valid(self):
        """No chart lies on another."""
        bpy.ops.object.mode_set(mode="EDIT")
        bpy.ops.mesh.reveal(select=False)
        self.assertEqual(bpy.ops.uv.atlas_refine_select_problems(), {"FINISHED"})
        bpy.ops.object.mode_set(mode="OBJECT")
        self.assertFalse([polygon.index for polygon in self.obj.data.polygons if polygon.select])

    def test_without_sync_the_uv_selection_counts(self):
        self.edit(faces=range(102), uvs=SECOND)
        self.refine()
        self.assertEqual(self.changed_faces(), list(SECOND))
        self.assert_valid()

    def test_with_sync_the_selected_faces_count(self):
        self.edit(faces=[50], uvs=range(102), sync=True)
        self.refine()
        self.assertEqual(self.changed_faces(), list(SECOND))

    @unittest.skipUnless(bpy.app.version >= (5, 0, 0), "before 5.0 the mesh's selection is all there is with sync")
    def test_with_sync_the_uv_editors_own_selection_counts(self):
        """Vertices of a seam are selected on both sides in the mesh, on one in the UV editor."""
        self.edit(faces=[*FIRST, *SECOND], uvs=SECOND, sync=True)
        bmesh.from_edit_mesh(self.obj.data).uv_select_sync_valid = True
        self.assertEqual(bpy.ops.uv.atlas_refine(**LOW), {"FINISHED"})
        self.assertEqual(self.changed_faces(), list(SECOND))

    @unittest.skipUnless(bpy.app.version >= (5, 0, 0), "before 5.0 the mesh's selection is all there is with sync")
    def test_with_sync_what_the_uv_editor_selects_counts(self):
        bpy.context.scene.tool_settings.use_uv_select_sync = True
        bpy.ops.object.mode_set(mode="EDIT")
        bpy.ops.mesh.select_mode(type="VERT")
        bpy.ops.mesh.select_all(action="DESELECT")
        mesh = bmesh.from_edit_mesh(self.obj.data)
        mesh.uv_select_sync_from_mesh()
        loops = [loop for face in mesh.faces if face.index in SECOND for loop in face.loops]
        mesh.uv_select_foreach_set(True, loop_verts=loops)
        mesh.uv_select_flush_mode()
        mesh.uv_select_sync_to_mesh()
        bmesh.update_edit_mesh(self.obj.data)
        self.assertTrue(mesh.uv_select_sync_valid)
        self.assertEqual(bpy.ops.uv.atlas_refine(**LOW), {"FINISHED"})
        self.assertEqual(self.changed_faces(), list(SECOND))

    def test_uvs_of_faces_that_the_uv_editor_does_not_show_do_not_count(self):
        self.edit(faces=SECOND, uvs=range(102))
        self.refine()
        self.assertEqual(self.changed_faces(), list(SECOND))

    def test_everything_selected(self):
        self.edit(faces=range(102), uvs=range(102))
        self.refine(pe_bound=0.8)
        self.assertEqual(self.changed_faces(), list(range(102)))

    def test_nothing_selected_says_so(self):
        self.edit(faces=range(102))
        with self.assertRaisesRegex(RuntimeError, "Loose: no chart is selected"):
            bpy.ops.uv.atlas_refine()
        self.assertEqual(self.changed_faces(), [])

    def test_in_object_mode_with_nothing_selected_the_active_object_is_taken_where_it_is_seen(self):
        self.obj.select_set(False)
        self.assertIs(bpy.context.view_layer.objects.active, self.obj)
        self.obj.hide_set(True)
        self.assertFalse(bpy.ops.uv.atlas_refine.poll())
        self.obj.hide_set(False)
        self.assertEqual(bpy.ops.uv.atlas_refine(), {"FINISHED"})

    def test_pinned_charts_stay_and_others_go_around_them(self):
        pin(self.obj, [3])
        self.refine(pe_bound=0.6)
        self.assertEqual(self.changed_faces(), [*SECOND, *THIRD])
        self.assert_valid()

    def test_pins_in_edit_mode(self):
        pin(self.obj, [90])
        self.edit(faces=range(102), uvs=range(102))
        self.refine(pe_bound=0.6)
        self.assertEqual(self.changed_faces(), [*FIRST, *SECOND])

    def test_everything_pinned_says_so(self):
        pin(self.obj, range(102))
        with self.assertRaisesRegex(RuntimeError, "Loose: every chart that is selected is pinned"):
            bpy.ops.uv.atlas_refine()
        self.assertEqual(self.changed_faces(), [])

    def test_hidden_charts_stay(self):
        self.edit(faces=range(102), uvs=range(102), hidden=SECOND)
        self.refine(pe_bound=0.7)
        self.assertEqual(self.changed_faces(), [*FIRST, *THIRD])

    def test_hidden_faces_stay_in_object_mode_too(self):
        for polygon in self.obj.data.polygons:
            polygon.hide = polygon.index in THIRD
        self.refine(pe_bound=0.7)
        self.assertEqual(self.changed_faces(), [*FIRST, *SECOND])

    def test_a_chart_that_is_hidden_in_part_stays_as_a_whole(self):
        self.edit(faces=range(102), uvs=range(102), hidden=[50])
        self.refine(pe_bound=0.6)
        self.assertEqual(self.changed_faces(), [*FIRST, *THIRD])
        self.assert_valid()

    def test_object_mode_takes_all_whatever_is_selected_in_edit_mode(self):
        self.edit(faces=[50], uvs=[50])
        bpy.ops.object.mode_set(mode="OBJECT")
        self.refine(pe_bound=0.8)
        self.assertEqual(self.changed_faces(), list(range(102)))

    def test_cuts_across_faces_need_all_charts(self):
        self.edit(faces=range(102), uvs=range(102), hidden=SECOND)
        with self.assertRaisesRegex(RuntimeError, "need all charts"):
            bpy.ops.uv.atlas_refine(seams="RECTANGLES", cut="SPLIT")
        self.assertEqual(self.changed_faces(), [])
