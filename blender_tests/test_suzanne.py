"""Suzanne, subdivided up to three times, in each of Blender's unwraps, at the default settings: all of her refined, not more distorted
than before, no edge torn. The figures are printed."""

import math
import sys
import time
import unittest

import bpy
from support import MODULE, fresh_scene, get_uvs, messages, texture_share
from test_equal_uvs import torn_edges

WORST_RISE = 0.02  # of E_d

UNWRAPS = {
    "Smart UV": lambda: bpy.ops.uv.smart_project(angle_limit=math.radians(66), island_margin=0.003),
    "angle based": lambda: bpy.ops.uv.unwrap(method="ANGLE_BASED", margin=0.003),
    "conformal": lambda: bpy.ops.uv.unwrap(method="CONFORMAL", margin=0.003),
    "cube projection": lambda: bpy.ops.uv.cube_project(),
}


def add_suzanne(levels, unwrap):
    """Without marked seams, as she comes."""
    bpy.ops.mesh.primitive_monkey_add()
    obj = bpy.context.object
    if levels:
        obj.modifiers.new("Subdivision", "SUBSURF").levels = levels
        bpy.ops.object.modifier_apply(modifier="Subdivision")
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    UNWRAPS[unwrap]()
    bpy.ops.object.mode_set(mode="OBJECT")
    return obj


class Suzanne(unittest.TestCase):
    def check(self, levels, unwrap, density):
        fresh_scene()
        obj = add_suzanne(levels, unwrap)
        before = torn_edges(obj.data)
        began = time.process_time()
        told = messages(bpy.ops.uv.atlas_refine, pe_bound=0.8, density=density)
        seconds = time.process_time() - began
        last = sys.modules[f"{MODULE}.tasks"].last
        self.assertIsNotNone(last, told)
        result = last[0].result
        torn = torn_edges(obj.data) - before
        left = sum(chart.fate == "left" for chart in result.charts)
        print(
            f"    Suzanne {levels}, {unwrap}, {density}: use {result.before.pe_fixed_aspect:.3f} -> {result.after.pe_fixed_aspect:.3f}, "
            f"E_d {result.before.distortion:.4f} -> {result.after.distortion:.4f}, charts {result.before.chart_count} -> "
            f"{result.after.chart_count}, left {left}, torn {len(torn)}, {seconds:.1f} s",
            flush=True,
        )
        self.assertGreaterEqual(result.after.pe_fixed_aspect, 0.8 - 1e-9)
        if unwrap != "cube projection":  # which stacks mirrored charts; texture_share() asks for none turned over
            self.assertGreaterEqual(texture_share(obj), 0.8 - 1e-9)
        self.assertLessEqual(result.after.distortion, result.before.distortion + WORST_RISE)
        self.assertEqual((torn, left), (set(), 0))

    def check_all(self, levels):
        for density in ("KEEP", "EQUAL"):
            for unwrap in UNWRAPS:
                with self.subTest(unwrap=unwrap, density=density):
                    self.check(levels, unwrap, density)

    def test_what_was_asked_of_the_mesh_before_changes_nothing(self):
        results = []
        for asked in (False, True):
            fresh_scene()
            obj = add_suzanne(0, "Smart UV")
            if asked and hasattr(obj.data, "calc_normals_split"):  # until 4.0, as exporters and drawing do
                obj.data.calc_normals_split()
            bpy.ops.uv.atlas_refine()
            results.append(get_uvs(obj.data.uv_layers.active))
        self.assertTrue((results[0] == results[1]).all())

    def test_as_she_comes(self):
        self.check_all(0)

    def test_subdivided(self):
        self.check_all(1)

    def test_subdivided_twice(self):
        self.check_all(2)

    def test_subdivided_three_times(self):
        """Of Smart UV a chart of a quarter of her faces overlaps itself, with a flap far into a hole."""
        self.check_all(3)
