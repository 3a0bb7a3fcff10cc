"""The checker itself: it accepts good atlases and finds each kind of defect."""

import itertools
import math
import subprocess
import sys
from pathlib import Path

import check_atlas
import numpy as np
import pytest
from borders import Boundary
from exact import exactly_touch, polygon_is_simple
from obj_text import read_obj
from taking_part import keeps_uvs, near_edges
from topology import Topology

SHEET = 3  # quads along a side of a sheet


def sheet(u0, v0, side, place=0.0, turn_deg=0.0, removed=()):
    """A flat square sheet of quads, UVs in a square from (u0, v0); `removed` quads leave holes."""
    n, c, s = SHEET + 1, math.cos(math.radians(turn_deg)), math.sin(math.radians(turn_deg))
    grid = [(i / SHEET, j / SHEET) for j in range(n) for i in range(n)]
    positions = [(x + place, y, 0.0) for x, y in grid]
    uvs = [(u0 + side * (c * x - s * y), v0 + side * (s * x + c * y)) for x, y in grid]
    quads = [(j * n + i, j * n + i + 1, (j + 1) * n + i + 1, (j + 1) * n + i) for j in range(SHEET) for i in range(SHEET)]
    return positions, uvs, [q for k, q in enumerate(quads) if k not in removed]


def text_of(*charts):
    lines, base = ["mtllib a.mtl"], 1
    for k, (positions, uvs, faces) in enumerate(charts):
        lines += [f"g chart{k}", f"usemtl m{k}"]
        lines += [f"v {x!r} {y!r} {z!r}" for x, y, z in positions]
        lines += [f"vt {float(u)!r} {float(v)!r}" for u, v in uvs]
        lines += ["f " + " ".join(f"{base + i}/{base + i}" for i in face) for face in faces]
        base += len(positions)
    return "\n".join(lines) + "\n"


def mesh(uvs, faces, positions=None):
    return positions or [(float(u), float(v), 0.1 * k * k) for k, (u, v) in enumerate(uvs)], uvs, faces


def check(tmp_path, before, after, **options):
    (tmp_path / "in.obj").write_text(before)
    (tmp_path / "out.obj").write_text(after)
    return check_atlas.check(tmp_path / "in.obj", tmp_path / "out.obj", **options)


def problems(tmp_path, after, before=None, **options):
    found = check(tmp_path, before or after, after, **options)
    assert found["ok"] == (not found["problems"])
    return " | ".join(found["problems"])


def stretched(chart, u, v=1.0):
    """A chart with its UVs multiplied."""
    positions, uvs, faces = chart
    return positions, [(u * a, v * b) for a, b in uvs], faces


GOOD = text_of(sheet(0, 0, 0.4), sheet(0.6, 0, 0.4, place=2.0))


def test_good_atlas(tmp_path):
    found = check(tmp_path, GOOD, GOOD, pe_bound=0.8, gap=0.18)
    assert found["problems"] == []
    assert (found["charts"], found["added_seams"], found["flipped"], found["contacts"]) == (2, 0, 0, 0)
    assert found["pe"] == pytest.approx(0.8)
    assert found["gap"] == pytest.approx(0.2 / math.hypot(1, 0.4))
    assert found["e_d"] == pytest.approx(1)


def test_moved_atlas_is_good(tmp_path):
    moved = text_of(sheet(0.1, 0.1, 0.3, turn_deg=20), sheet(0.6, 0.2, 0.3, place=2.0))
    assert problems(tmp_path, moved, GOOD) == ""


def test_missed_bound(tmp_path):
    assert problems(tmp_path, GOOD, pe_bound=0.81).startswith("PE: 0.8")
    assert problems(tmp_path, GOOD, pe_bound=0.5, aspect=1.0).startswith("PE: 0.32")


def test_missed_gap(tmp_path):
    assert problems(tmp_path, GOOD, gap=0.2).startswith("gap: 0.185")
    assert problems(tmp_path, GOOD, gap=0.2, gap_unit="long_side") == ""


WIDE = (sheet(0, 0, 0.9), sheet(1.1, 0, 0.9, place=2.0))  # two squares in a box of 2:0.9, in units where both sides count alike


def test_uvs_that_fill_a_wide_texture(tmp_path):
    """In a texture of 2:1 u is halved: the squares are squares there again, 0.1 of its long side apart."""
    filling = text_of(*(stretched(chart, 0.5) for chart in WIDE))
    found = check(tmp_path, filling, filling, pe_bound=0.8, aspect=2.0, gap=0.099, gap_unit="long_side")
    assert found["problems"] == []
    assert found["fills_texture"]
    assert found["pe_fixed_aspect"] == pytest.approx(0.81)
    assert found["texture_share"] == pytest.approx(0.81)
    assert found["pe"] == pytest.approx(0.9)
    assert found["gap"] == pytest.approx(0.1)
    assert (found["e_d_in"], found["e_d"]) == (pytest.approx(1), pytest.approx(1))
    assert problems(tmp_path, filling, aspect=2.0, gap=0.101, gap_unit="long_side").startswith("gap: 0.1")


def test_uvs_that_fill_half_of_a_wide_texture(tmp_path):
    """With both sides in one unit they cover the lower half of the square: half the share, and everything twice as wide."""
    half = text_of(*(stretched(chart, 0.5, 0.5) for chart in WIDE))
    found = check(tmp_path, half, half, pe_bound=0.8, aspect=2.0)
    assert found["problems"] == ["PE: 0.405000 is below 0.8"]
    assert found["texture_share"] == pytest.approx(0.405)
    assert found["e_d"] == pytest.approx(1.25)
    assert check(tmp_path, half, half, pe_bound=0.8)["problems"] == []


def test_tall_texture(tmp_path):
    tall = text_of(*((p, [(v, 0.5 * u) for u, v in uvs], [face[::-1] for face in faces]) for p, uvs, faces in WIDE))
    found = check(tmp_path, tall, tall, pe_bound=0.8, aspect=0.5, gap=0.099, gap_unit="long_side")
    assert found["problems"] == []
    assert found["pe_fixed_aspect"] == pytest.approx(0.81)
    assert found["gap"] == pytest.approx(0.1)
    assert found["e_d"] == pytest.approx(1)
    assert check(tmp_path, tall, tall, aspect=2.0)["e_d"] == pytest.approx(2.125)


def test_gap_of_the_texture_or_of_the_charts_own_box(tmp_path):
    """The charts' box is 1 by 0.4; the texture's diagonal is that of the square around it."""
    assert check(tmp_path, GOOD, GOOD, aspect=1.0)["gap"] == pytest.approx(0.2 / math.sqrt(2))
    assert check(tmp_path, GOOD, GOOD, aspect=1.0, gap_box="charts")["gap"] == pytest.approx(0.2 / math.hypot(1, 0.4))
    assert check(tmp_path, GOOD, GOOD)["gap"] == pytest.approx(0.2 / math.hypot(1, 0.4))


@pytest.mark.parametrize(
    ("chart", "fills"),
    [
        (sheet(0, 0, 1), True),
        (stretched(sheet(0, 0, 1), 1, 0.5), True),
        (sheet(0, 0, 0.9), False),
        (sheet(0.1, 0, 1), False),
        (sheet(0, -0.1, 1.1), False),
    ],
)
def test_fills_the_texture(tmp_path, chart, fills):
    assert check(tmp_path, text_of(chart), text_of(chart), aspect=1.0)["fills_texture"] == fills


@pytest.mark.parametrize("width", [7.0, 1 / 7])
def test_exact_tests_do_not_depend_on_the_texture(tmp_path, width):
    """One rounding step of area or of distance is there or not whatever u is multiplied by."""
    thin = [(0.0, 0.0), (1.0, 1.0), (0.5, math.nextafter(0.5, 1))]
    assert problems(tmp_path, text_of(mesh(thin, [(0, 1, 2)])), aspect=width) == ""
    square = mesh([(0.0, 0.0), (0.5, 0.0), (0.5, 1.0), (0.0, 1.0)], [(0, 1, 2, 3)])
    for x, good in ((math.nextafter(0.5, 1), True), (0.5, False)):
        tip = mesh([(x, 0.3), (1.0, 0.0), (1.0, 0.9)], [(0, 1, 2)], [(3.0, 0, 0), (4.0, 0, 0), (4.0, 1, 0)])
        assert ("borders" not in problems(tmp_path, text_of(square, tip), aspect=width)) == good


def test_gap_far_larger_than_an_edge(tmp_path):
    far = text_of(sheet(0, 0, 0.01), sheet(0.9, 0.3, 0.01, place=2.0))
    assert check(tmp_path, far, far)["gap"] == pytest.approx(math.hypot(0.89, 0.29) / math.hypot(0.91, 0.31))


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("v 2.0 0.0 0.0", "v 2.0 0.0 1e-9"),
        ("usemtl m1", "usemtl m0"),
        ("g chart1", "g chart"),
        ("f 1/1 2/2 6/6 5/5\nf 2/2 3/3 7/7 6/6", "f 2/2 3/3 7/7 6/6\nf 1/1 2/2 6/6 5/5"),
        ("f 1/1 2/2 6/6 5/5", "f 2/2 6/6 5/5 1/1"),
        ("f 1/1 2/2 6/6 5/5", "f 1/1 2/2 6/6\nf 1/1 6/6 5/5"),
        ("mtllib a.mtl\n", ""),
    ],
)
def test_changed_file(tmp_path, old, new):
    assert GOOD.count(old) == 1
    assert problems(tmp_path, GOOD.replace(old, new), GOOD).startswith("file:")


def test_new_seam(tmp_path):
    torn = GOOD.replace("f 1/1 2/2 6/6 5/5", "f 1/1 2/33 6/6 5/5") + "vt 0.13 0.0\n"
    found = check(tmp_path, GOOD, torn)
    assert found["added_seams"] == 1
    assert "seams: 1 added" in found["problems"][0]


def test_new_seam_that_is_allowed(tmp_path):
    apart = text_of(sheet(0, 0, 0.4)).replace("f 1/1 2/2 6/6 5/5", "f 1/17 2/18 6/19 5/20")
    whole = text_of(sheet(0, 0, 0.4))
    apart += "".join(f"vt {u} {v}\n" for u, v in [(0.6, 0.0), (0.7, 0.0), (0.7, 0.1), (0.6, 0.1)])
    found = check(tmp_path, whole, apart, added_seams=True)
    assert (found["problems"], found["added_seams"], found["charts"]) == ([], 2, 2)
    assert found["bl"] - found["bl_in"] == pytest.approx(2 / SHEET / math.sqrt(2))
    assert "seams: 2 removed" in problems(tmp_path, whole, apart, added_seams=True)
    divided = whole.replace("f 1/1 2/2 6/6 5/5", "f 1/1 2/2 6/6\nf 1/1 6/6 5/5")
    assert problems(tmp_path, divided, whole, added_seams=True).startswith("file:")


def test_closed_seam(tmp_path):
    torn = GOOD.replace("f 1/1 2/2 6/6 5/5", "f 1/1 2/33 6/6 5/5") + "vt 0.13 0.0\n"
    assert "seams: 1 removed" in problems(tmp_path, GOOD, torn)


def test_doubled_vertices_are_no_seam(tmp_path):
    """Vertices doubled for the sake of normals keep the chart whole: positions and UVs count."""
    uvs = [(0, 0), (1, 0), (1, 1), (0, 1), (1, 0), (2, 0), (2, 1), (1, 1)]
    doubled = text_of(mesh(uvs, [(0, 1, 2, 3), (4, 5, 6, 7)], [(float(u), float(v), 0.0) for u, v in uvs]))
    found = check(tmp_path, doubled, doubled)
    assert (found["problems"], found["charts"], found["seams"]) == ([], 1, 0)
    torn = doubled.replace("vt 1.0 1.0\nvt 0.0 1.0", "vt 0.9 1.0\nvt 0.0 1.0")
    assert "seams: 1 added" in problems(tmp_path, torn, doubled)


def separately(chart, moves=lambda face, u, v: (u, v)):
    """The chart with a UV of its own at every corner, `moves` applied to it; positions stay shared."""
    positions, uvs, faces = chart
    corners = [moves(k, *uvs[i]) for k, face in enumerate(faces) for i in face]
    lines = [f"v {x!r} {y!r} {z!r}" for x, y, z in positions] + [f"vt {float(u)!r} {float(v)!r}" for u, v in corners]
    first = itertools.count(1)
    lines += ["f " + " ".join(f"{i + 1}/{next(first)}" for i in face) for face in faces]
    return "\n".join(lines) + "\n"


def noise(face, u, v):
    random = np.random.default_rng([face, round(1e3 * u), round(1e3 * v)])
    return u + random.uniform(-3e-7, 3e-7), v + random.uniform(-3e-7, 3e-7)


def test_noise_is_no_seam(tmp_path):
    noisy, whole = separately(sheet(0, 0, 1), noise), separately(sheet(0, 0, 1))
    kept = check(tmp_path, noisy, noisy)
    assert (kept["problems"], kept["charts"], kept["seams"]) == ([], 1, 0)
    moved = check(tmp_path, noisy, whole)
    assert (moved["problems"], moved["added_seams"], moved["removed_seams"]) == ([], 0, 0)


def test_a_noisy_edge_that_is_torn(tmp_path):
    torn = check(tmp_path, separately(sheet(0, 0, 1), noise), separately(sheet(0, 0, 1), lambda k, u, v: (u, v + 2.0 * (k > 5))))
    assert torn["added_seams"] == 3
    assert "seams: 3 added" in torn["problems"][0]


def test_noise_in_a_result_is_a_seam(tmp_path):
    """What was written has to be one to the last bit."""
    assert "seams: 12 added" in problems(tmp_path, separately(sheet(0, 0, 1), noise), separately(sheet(0, 0, 1)))


def test_charts_nearer_than_noise_are_not_one_where_that_is_much_of_an_edge(tmp_path):
    near = separately(sheet(0, 0, 1e-4), lambda k, u, v: (u, v + 4e-6 * (k > 5)))
    assert check(tmp_path, near, near)["charts"] == 2


def test_noise_that_adds_up_around_a_vertex_leaves_no_hole_of_two_sides(tmp_path):
    around = [4, 3, 0, 1]  # faces at (1/3, 1/3); the first and the last have an inner edge in common

    def grown(face, u, v):
        at_vertex = face in around and np.hypot(u - 1 / 3, v - 1 / 3) < 1e-6
        return (u + 7e-5 * around.index(face) if at_vertex else u, v)

    assert check(tmp_path, separately(sheet(0, 0, 1), grown), separately(sheet(0, 0, 1)), cuts=True)["problems"] == []


def test_a_duplicate_face_is_a_chart(tmp_path):
    positions, uvs, faces = sheet(0, 0, 1)
    for double, moves in (
        (faces[4], lambda k, u, v: (u + 2.0 * (k == 9), v)),
        (faces[4][::-1], lambda k, u, v: (3 - u, v) if k == 9 else (u, v)),
    ):
        doubled = (positions, uvs, [*faces, double])
        found = check(tmp_path, separately(doubled), separately(doubled, moves))
        assert (found["problems"], found["charts"], found["added_seams"]) == ([], 2, 0)


def test_front_and_back_are_two_charts(tmp_path):
    positions, uvs, faces = sheet(0, 0, 1)
    both = (positions, uvs, [*faces, *(face[::-1] for face in faces)])
    moved = separately(both, lambda k, u, v: (2.5 - u, v) if k >= len(faces) else (u, v))
    found = check(tmp_path, separately(both), moved)
    assert (found["problems"], found["charts"], found["added_seams"]) == ([], 2, 0)


def test_a_parted_fold_is_counted_and_allowed(tmp_path):
    positions, uvs, faces = sheet(0, 0, 1)
    folded = separately((positions, uvs, faces), lambda k, u, v: (min(u, 2 / 3 - u), v))
    parted = separately((positions, uvs, faces), lambda k, u, v: (u, v + 2.0 * (k % 3 > 0)))
    found = check(tmp_path, folded.replace("0.33333333333333337", "0.3333333333333333"), parted)
    assert (found["problems"], found["added_seams"], found["parted_folds"]) == ([], 3, 3)


def test_a_pinch_is_no_contact(tmp_path):
    pinched = text_of(sheet(0, 0, 1, removed=(0, 4)))
    assert problems(tmp_path, pinched) == ""
    assert problems(tmp_path, pinched.replace("vt 0.0 0.3333333333333333\n", "vt 0.35 0.2\n")) != ""


def test_fans_that_reach_into_each_other_at_a_pinch(tmp_path):
    """A chart whose first and last faces meet at one vertex; then the last one is turned into the first."""
    uvs = [(0, 0), (2, -1), (2, 1), (-2, 1), (-2, -1), (-3, 3), (3, 3), (4, 0), (-4, 0)]
    faces = [(0, 1, 2), (0, 3, 4), (2, 6, 5, 3), (2, 1, 7), (2, 7, 6), (4, 3, 8), (3, 5, 8)]
    good = mesh(uvs, faces)
    assert problems(tmp_path, text_of(good)) == ""
    turned = (good[0], [*uvs[:4], (1.5, -0.3), *uvs[5:]], faces)
    assert "borders" in problems(tmp_path, text_of(turned), text_of(good))


def test_flipped_triangle(tmp_path):
    good = mesh([(0, 0), (1, 0), (1, 1), (0, 1), (0.5, 0.5)], [(0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4)])
    bad = (good[0], [*good[1][:4], (0.5, -0.1)], good[2])
    assert "flipped or flat: 1 faces, first 0" in problems(tmp_path, text_of(bad), text_of(good))


def test_mirrored_chart(tmp_path):
    positions, uvs, faces = sheet(0, 0, 1)
    assert "flipped" in problems(tmp_path, text_of((positions, [(-u, v) for u, v in uvs], faces)))


def test_flat_triangle_of_exactly_zero_area(tmp_path):
    flat = mesh([(0.1, 0.1), (0.3, 0.3), (0.5, 0.5), (0.0, 1.0)], [(0, 1, 2), (0, 2, 3)])
    assert "flipped or flat: 1" in problems(tmp_path, text_of(flat))


def test_area_of_one_rounding_step_is_positive(tmp_path):
    """1e-17 of area, which floating point cannot tell from zero: one way valid, the other way flipped."""
    thin = [(0.0, 0.0), (1.0, 1.0), (0.5, math.nextafter(0.5, 1))]
    assert problems(tmp_path, text_of(mesh(thin, [(0, 1, 2)]))) == ""
    thin[2] = (0.5, math.nextafter(0.5, 0))
    assert "flipped" in problems(tmp_path, text_of(mesh(thin, [(0, 1, 2)])))


def test_polygon_that_is_not_convex_is_good(tmp_path):
    dart = [(0.0, 0.0), (1.0, 0.0), (0.25, 0.25), (0.0, 1.0)]
    for turn in range(4):
        assert problems(tmp_path, text_of(mesh(dart, [tuple((k + turn) % 4 for k in range(4))]))) == ""


def test_quad_that_became_concave(tmp_path):
    """Valid by one diagonal either way: the fan of some turns is flipped, of others not, and one diagonal is."""
    square, dart = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)], [(0.0, 0.0), (1.0, 0.0), (0.25, 0.25), (0.0, 1.0)]
    for turn in range(4):
        face = tuple((k + turn) % 4 for k in range(4))
        flat = [(u, v, 0.0) for u, v in square]
        found = problems(tmp_path, text_of((flat, dart, [face])), text_of((flat, square, [face])))
        assert ("fan" in found) == (turn % 2 == 1)
        assert "diagonals: 1 faces" in found
        assert "ears" not in found
        assert problems(tmp_path, text_of((flat, square, [face])), text_of((flat, dart, [face]))) == ""


def test_distortion_of_a_quad_is_the_mean_of_both_diagonals(tmp_path):
    """Bent in space along one diagonal, a square in the UV plane, whichever corner comes first."""
    uvs = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]
    bent = [(u, v, 0.8 * (u == v == 1.0)) for u, v in uvs]
    found = [check(tmp_path, *[text_of((bent, uvs, [tuple((k + turn) % 4 for k in range(4))]))] * 2)["e_d"] for turn in range(4)]
    assert found == [pytest.approx(found[0], rel=1e-12)] * 4
    (tmp_path / "a.obj").write_text(text_of((bent, uvs, [(0, 1, 2, 3)])))
    obj = check_atlas.read_obj(tmp_path / "a.obj")
    ways = [check_atlas.np.array(way) for way in ([(0, 1, 2), (0, 2, 3)], [(0, 1, 3), (1, 2, 3)])]
    every, half = check_atlas.np.concatenate(ways), check_atlas.np.full(4, 0.5)
    assert found[0] == pytest.approx(check_atlas.distortion(obj, every, half)[0], rel=1e-12)
    assert min(check_atlas.distortion(obj, way)[0] for way in ways) < found[0]


def test_polygon_that_crosses_itself(tmp_path):
    bow = [(0.0, 0.0), (1.0, 0.0), (0.2, 1.0), (1.0, 1.0)]
    assert "flipped" in problems(tmp_path, text_of(mesh(bow, [(0, 1, 2, 3)])))


def test_face_wound_against_its_chart_is_good(tmp_path):
    quads = mesh([(0, 0), (1, 0), (2, 0), (2, 1), (1, 1), (0, 1)], [(0, 1, 4, 5), (3, 2, 1, 4)])
    found = check(tmp_path, text_of(quads), text_of(quads))
    assert found["problems"] == []
    assert (found["charts"], found["pe"]) == (1, pytest.approx(1))


def test_charts_that_cross(tmp_path):
    assert "borders" in problems(tmp_path, text_of(sheet(0, 0, 0.4), sheet(0.3, 0.1, 0.4, place=2.0)))


def test_charts_that_touch_at_a_corner(tmp_path):
    touching = text_of(sheet(0, 0, 0.5), sheet(0.5, 0.5, 0.5, place=2.0))
    assert "borders" in problems(tmp_path, touching)


def test_corner_that_touches_a_side(tmp_path):
    """The tip lies on the side exactly, one rounding step away, one step beyond."""
    square = mesh([(0.0, 0.0), (0.5, 0.0), (0.5, 1.0), (0.0, 1.0)], [(0, 1, 2, 3)])

    def with_tip(x):
        tip = mesh([(x, 0.3), (1.0, 0.0), (1.0, 0.9)], [(0, 1, 2)], [(3.0, 0, 0), (4.0, 0, 0), (4.0, 1, 0)])
        return problems(tmp_path, text_of(square, tip))

    assert "borders" in with_tip(0.5)
    assert "borders" in with_tip(math.nextafter(0.5, 0))
    assert with_tip(math.nextafter(0.5, 1)) == ""


def test_border_that_folds_back_on_itself(tmp_path):
    straight = mesh([(0.0, 0.0), (2.0, 0.0), (1.0, 0.0), (1.0, 1.0)], [(0, 2, 3), (2, 1, 3)])
    assert problems(tmp_path, text_of(straight)) == ""
    slit = [(0.0, 0.0), (2.0, 0.0), (2.0, 1.0), (1.0, 1.0), (1.0, 0.5), (1.0, 1.0), (0.0, 1.0)]
    faces = [(0, 1, 4), (1, 2, 4), (2, 3, 4), (4, 5, 6), (4, 6, 0)]
    assert "borders" in problems(tmp_path, text_of(mesh(slit, faces)))


def test_chart_that_touches_itself(tmp_path):
    """Two corners of one chart at one point, though its faces meet nowhere near."""
    apart = mesh([(0, 0), (3, 0), (3, 3), (2, 1), (1, 1), (0, 3)], [(0, 1, 3, 4), (1, 2, 3), (0, 4, 5)])
    assert problems(tmp_path, text_of(apart)) == ""
    touching = (apart[0], [(0, 0), (3, 0), (1.5, 3), (2, 1), (1, 1), (1.5, 3)], apart[2])
    assert "borders" in problems(tmp_path, text_of(touching), text_of(apart))


def test_chart_inside_a_chart(tmp_path):
    assert "borders: 1 loops lie inside" in problems(tmp_path, text_of(sheet(0, 0, 1), sheet(0.4, 0.4, 0.1, place=2.0)))


def test_chart_inside_a_hole_is_good(tmp_path):
    ring = sheet(0, 0, 1, removed=(4,))
    assert problems(tmp_path, text_of(ring, sheet(0.4, 0.4, 0.2, place=2.0))) == ""


def test_two_charts_one_above_the_other(tmp_path):
    ring = sheet(0, 0, 1, removed=(4,))
    assert "borders" in problems(tmp_path, text_of(ring, sheet(0.45, 0.45, 0.1, place=2.0), sheet(0.46, 0.46, 0.02, place=4.0)))


def test_distortion_of_a_stretched_sheet(tmp_path):
    positions, uvs, faces = sheet(0, 0, 1)
    found = check(tmp_path, GOOD, GOOD)
    assert found["e_d_in"] == pytest.approx(1)
    stretched = text_of((positions, [(2 * u, v) for u, v in uvs], faces))
    found = check(tmp_path, stretched, stretched)
    assert found["e_d"] == pytest.approx(1.25)
    assert found["stretch_max"] == pytest.approx(math.sqrt(2))


def test_contacts_agree_with_brute_force(tmp_path):
    """Two overlapping sheets at every angle: the grid misses no pair of edges."""
    for turn in range(0, 90, 7):
        text = text_of(sheet(0, 0, 1), sheet(0.3, -0.2, 0.9, place=2.0, turn_deg=turn))
        (tmp_path / "a.obj").write_text(text)
        obj = check_atlas.read_obj(tmp_path / "a.obj")
        border = Boundary(obj, Topology(obj))
        count = len(border.a)
        apart = [(i, j) for i in range(count) for j in range(i) if border.chart[i] != border.chart[j]]
        brute = sum(exactly_touch(*border.pairs(i, j)) for i, j in apart)
        assert brute > 0
        assert len(border.contacts_and_gap(0)[0]) == brute


def test_command_line(tmp_path):
    (tmp_path / "a.obj").write_text(GOOD)
    script = Path(check_atlas.__file__)

    def run(*arguments):
        return subprocess.run([sys.executable, script, *arguments], capture_output=True, text=True, check=False)

    good = run(tmp_path / "a.obj", tmp_path / "a.obj", "--pe-bound", "0.8")
    assert (good.returncode, good.stdout.count("\n"), good.stderr) == (0, 1, "")
    assert run(tmp_path / "a.obj", tmp_path / "a.obj", "--pe-bound", "0.9").returncode == 1
    (tmp_path / "torn.obj").write_text(GOOD.replace("f 1/1 2/2 6/6 5/5", "f 1/1 2/33 6/6 5/5") + "vt 0.13 0.0\n")
    assert run(tmp_path / "a.obj", tmp_path / "torn.obj").returncode == 1
    assert run(tmp_path / "a.obj", tmp_path / "torn.obj", "--added-seams").returncode == 0
    assert run(tmp_path / "a.obj", tmp_path / "a.obj", "--pe-bound", "0.8", "--aspect", "square").returncode == 1
    assert run(tmp_path / "a.obj", tmp_path / "a.obj", "--pe-bound", "0.8", "--aspect", "wide").returncode == 2
    assert run(tmp_path / "a.obj", tmp_path / "missing.obj").returncode == 2


SQUARE, HOLE = [(0, 0), (3, 0), (3, 3), (0, 3)], [(1, 1), (1, 2), (2, 2), (2, 1)]
KEYHOLES = {
    "good": ([*SQUARE, SQUARE[0], *HOLE, HOLE[0]], True),
    "turned over": ([*SQUARE, SQUARE[0], *HOLE, HOLE[0]][::-1], False),
    "hole wound like the outline": ([*SQUARE, SQUARE[0], HOLE[0], *HOLE[:0:-1], HOLE[0]], False),
    "hole outside": ([*SQUARE, SQUARE[0], *((x - 4, y) for x, y in HOLE), (-3, 1)], False),
    "hole across the outline": ([*SQUARE, SQUARE[0], *((x + 1.5, y) for x, y in HOLE), (2.5, 1)], False),
    "bridge through the hole": ([*SQUARE, SQUARE[0], *HOLE[2:], *HOLE[:2], HOLE[2]], False),
    "a spike": ([*SQUARE, (0, 0), (1, 1)], False),
}


@pytest.mark.parametrize("case", KEYHOLES)
def test_keyholes(case):
    points, good = KEYHOLES[case]
    assert polygon_is_simple([(float(x), float(y)) for x, y in points]) is good


def test_nothing_takes_part(tmp_path):
    text = text_of(sheet(0, 0, 0))
    charts = [{"fate": "left", "face_ranges": [[0, SHEET**2 - 1]]}]
    found = check(tmp_path, text, text, charts=charts)
    assert found["ok"], found["problems"]
    assert found["faces"] == 0


def test_faces_without_area_in_space_only(tmp_path):
    """None of them has a shape that it could lose."""
    flat = [(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (2.0, 0.0, 0.0)]
    text = text_of(mesh([(0, 0), (1, 0), (0, 1)], [(0, 1, 2)], flat))
    assert check(tmp_path, text, text)["e_d"] == 1


def test_a_follower_may_have_a_vertex_on_its_leaders_edge(tmp_path):
    (tmp_path / "a.obj").write_text(text_of(sheet(0, 0, 1)))
    obj = read_obj(tmp_path / "a.obj")
    points = np.array([[0.1, 0], [0.1, 1e-6], [1 / 3, 0.2], [0.1, 0.1], [-0.1, 0]])
    assert near_edges(points, obj, 1e-9).tolist() == [True, False, True, False, False]


@pytest.mark.parametrize(
    ("uv", "parts", "good"),
    [
        ("0.5 0", "f 1/1 4/4 2/2 3/3", True),
        ("0.5 0", "f 1/1 4/4 3/3\nf 4/4 2/2 3/3", True),
        ("0.5 0.1", "f 1/1 4/4 2/2 3/3", False),
        ("0.5 0", "f 1/2 4/4 2/2 3/3", False),
    ],
)
def test_a_face_that_was_left_may_get_a_point(tmp_path, uv, parts, good):
    text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0.5 0 0\nvt 0 0\nvt 1 0\nvt 0 1\nvt " + uv + "\n"
    for name, faces in (("a", "f 1/1 2/2 3/3"), ("b", parts)):
        (tmp_path / f"{name}.obj").write_text(text + faces + "\n")
    before, after = (read_obj(tmp_path / f"{name}.obj") for name in "ab")
    assert keeps_uvs(before, after, np.zeros(after.faces, dtype=int)) is good
