"""Options of refine() that say what a chart, a face or an edge may become: each is seen in the result."""

import atlas_refine
import numpy as np
import pytest
import shapes

FAST = {"seams": "rectangles", "candidates": 20}


def faces_of(first, last):
    """Flags of the faces of shapes.loose(), whose three charts have 48, 36 and 18 faces."""
    flags = np.zeros(48 + 36 + 18, dtype=bool)
    flags[first:last] = True
    return flags


def corners_of(first, last):
    return slice(4 * first, 4 * last)


def cube():
    """A closed cube whose UVs are a point: no flat map has it without a seam."""
    positions = np.array([[x, y, z] for z in (0.0, 1.0) for y in (0.0, 1.0) for x in (0.0, 1.0)])
    faces = np.array([[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]])
    return positions, np.arange(0, 25, 4), faces.ravel(), np.full((24, 2), 0.5)


def stacked():
    """Two sheets of the same shape on each other in the UVs, and one beside them."""
    return shapes.join(shapes.grid(4, 4), shapes.grid(4, 4), shapes.grid(6, 2, origin=(9.0, 8.0)))


def seams_of(result):
    return {tuple(sorted(pair)) for pair in result.new_seams.tolist()}


def test_a_closed_chart_is_left_unless_it_may_be_opened():
    arrays = cube()
    with pytest.raises(atlas_refine.AtlasRefineError, match="chart 0 has no boundary"):
        atlas_refine.refine(*arrays, pe_bound=0.5, collapsed="embed")
    result = atlas_refine.refine(*arrays, pe_bound=0.5, collapsed="embed", open_closed=True)
    assert result.charts[0].fate == "refined"
    assert len(seams_of(result)) == result.added_seams > 0
    validity = atlas_refine.validate(*arrays[:3], result.corner_uvs)
    assert validity.valid, validity.problem


@pytest.mark.parametrize("stacks", ["keep", "separate"])
def test_stacks(stacks):
    arrays = stacked()
    result = atlas_refine.refine(*arrays, pe_bound=0.6, stacks=stacks)
    first, second = result.corner_uvs[corners_of(0, 16)], result.corner_uvs[corners_of(16, 32)]
    assert np.array_equal(first, second) == (stacks == "keep")
    assert {chart.fate for chart in result.charts} == ({"refined", "stacked"} if stacks == "keep" else {"refined"})
    assert [chart.stacked_on for chart in result.charts][1] == (0 if stacks == "keep" else -1)
    assert np.bincount(result.face_charts).tolist() == [chart.faces for chart in result.charts]
    assert set(result.face_charts[:16]) == {0}


@pytest.mark.parametrize("collapsed", ["leave", "embed"])
def test_collapsed_charts(collapsed):
    flat = shapes.grid(3, 3)
    arrays = shapes.join(shapes.grid(6, 6, bend=1.0 / 7), (flat[0], flat[1], np.full_like(flat[2], 40.0)))
    result = atlas_refine.refine(*arrays, pe_bound=0.7, collapsed=collapsed)
    uvs = result.corner_uvs[corners_of(36, 45)]
    if collapsed == "leave":
        assert np.all(uvs == 40.0)
        assert result.charts[1].fate == "left"
        assert result.charts[1].reason
    else:
        assert np.ptp(uvs, axis=0).min() > 0
        assert result.charts[1].fate == "refined"
        assert atlas_refine.validate(*arrays[:3], result.corner_uvs).valid


@pytest.mark.parametrize(("rotate", "quarters"), [("none", (0,)), ("90", (0, 1, 2, 3))])
def test_rotate(rotate, quarters):
    """At a bound that moving alone holds, each chart is turned by none or by quarter turns."""
    arrays = shapes.join(shapes.grid(5, 3), shapes.grid(4, 7, origin=(30.0, 3.0)), shapes.grid(2, 6, origin=(2.0, 40.0)))
    result = atlas_refine.refine(*arrays, pe_bound=0.6, rotate=rotate)
    assert result.intervention == "moved"
    for begin in arrays[1][[0, 15, 43]]:
        (x0, y0), (x, y) = (uvs[begin + 1] - uvs[begin] for uvs in (arrays[3], result.corner_uvs))
        turn = np.degrees(np.arctan2(y, x) - np.arctan2(y0, x0)) / 90
        assert round(turn) % 4 in quarters
        assert turn == pytest.approx(round(turn), abs=1e-6)


def test_align_axes_turns_straight_borders_onto_an_axis():
    grids = [shapes.grid(7, 3), shapes.grid(5, 5, origin=(30.0, 0.0))]
    turn = np.array([[np.cos(0.3), np.sin(0.3)], [-np.sin(0.3), np.cos(0.3)]])
    arrays = shapes.join(*((positions, faces, uvs @ turn) for positions, faces, uvs in grids))
    result = atlas_refine.refine(*arrays, pe_bound=0.6, align_axes=True)
    assert result.intervention == "moved"
    for begin in arrays[1][[0, 21]]:
        edge = np.abs(result.corner_uvs[begin + 1] - result.corner_uvs[begin])
        assert edge.min() < 1e-9 * edge.max()


def test_triangulate_leaves_no_larger_polygon_where_a_face_is_cut():
    arrays = shapes.loose()
    plain = atlas_refine.refine(*arrays, **FAST).cut
    cut = atlas_refine.refine(*arrays, **FAST, triangulate=True).cut
    parts = np.bincount(cut.face_sources)[cut.face_sources]
    assert np.diff(cut.face_offsets)[parts > 1].max() == 3
    assert len(cut.face_sources) > len(plain.face_sources)


def test_groups_are_atlases_of_their_own():
    arrays = shapes.loose()
    groups = np.where(faces_of(0, 48), 0, 1)
    origins = [[0.0, 0.0], [1.0, 0.0]]
    result = atlas_refine.refine(
        *arrays, pe_bound=0.7, groups=groups, group_origins=origins, group_names=["bark", "leaf"], box_aspect=1.0
    )
    assert [(g.group, g.name, g.charts) for g in result.groups] == [(0, "bark", 1), (1, "leaf", 2)]
    assert all(g.bound_met and g.after.pe_fixed_aspect >= 0.7 for g in result.groups)
    bark, leaf = result.corner_uvs[corners_of(0, 48)], result.corner_uvs[corners_of(48, 102)]
    assert bark.min() >= 0
    assert bark.max() <= 1
    assert leaf[:, 0].min() >= 1
    assert leaf[:, 0].max() <= 2


def test_groups_have_boxes_and_gaps_of_their_own():
    arrays = shapes.loose()
    groups = np.where(faces_of(0, 48), 0, 1)
    common = {"pe_bound": 0.7, "groups": groups, "in_texture": True, "gap": 0.01, "gap_unit": "long_side"}
    result = atlas_refine.refine(*arrays, **common, group_aspects=[2.0, 0.5], group_gaps=[0.004, 0.008])
    assert [group.gap.value for group in result.groups] == [0.004, 0.008]
    for aspect, begin, end in ((2.0, 0, 48), (0.5, 48, 102)):
        offsets = arrays[1][begin : end + 1] - arrays[1][begin]
        corners = corners_of(begin, end)
        own = atlas_refine.measure(
            arrays[0], offsets, arrays[2][corners], result.corner_uvs[corners], box_aspect=aspect, in_texture=True
        )
        assert own.pe_fixed_aspect >= 0.7
    with pytest.raises(atlas_refine.AtlasRefineError, match="aspects of groups"):
        atlas_refine.refine(*arrays, **common, group_aspects=[0.0])


def test_a_gap_of_a_free_box_with_a_density_is_one_of_the_texture():
    arrays = shapes.loose()
    for density in (0.01, 0.1):
        options = {"pe_bound": 0.6, "uv_density": density, "gap": 0.002, "gap_unit": "long_side"}
        result = atlas_refine.refine(*arrays, **options)
        box = np.hypot(result.after.box_width, result.after.box_height)
        assert 0.002 <= result.after.gap_between * box < 0.01
        again = atlas_refine.refine(*arrays[:3], result.corner_uvs, **options)
        assert again.intervention == "unchanged"


@pytest.mark.parametrize("gap", [{}, {"gap": 0.004, "gap_unit": "long_side"}])
@pytest.mark.parametrize("aspect", [1.0, 2.0])
def test_a_texture_takes_the_density_that_is_asked_where_it_is_large_enough(aspect, gap):
    arrays = shapes.loose()
    options = {"pe_bound": 0.8, "box_aspect": aspect, "in_texture": True, "stored": "float32", **gap}
    full = atlas_refine.refine(*arrays, **options)
    area = sum(chart.area for chart in full.charts)

    def size(result):
        return np.sqrt(aspect * uv_area(arrays, result.corner_uvs) / area)

    for part in (0.1, 0.5, 0.9):
        density = part * size(full)
        result = atlas_refine.refine(*arrays, uv_density=density, **options)
        assert size(result) == pytest.approx(density, rel=1e-5)
        assert result.bound_met
        assert result.after.pe_fixed_aspect == pytest.approx(part**2 * full.after.pe_fixed_aspect, rel=1e-4)
        assert result.after.distortion < result.before.distortion + 1e-4
        own = atlas_refine.measure(*arrays[:3], result.corner_uvs, box_aspect=aspect, in_texture=True)
        assert atlas_refine.validate(*arrays[:3], result.corner_uvs).valid
        if gap:
            margin = 0.004 * max(aspect, 1.0)
            assert own.gap_between * np.hypot(own.box_width * aspect, own.box_height) >= margin - 1e-6
            stretched = result.corner_uvs * [aspect, 1.0]
            assert stretched.min() >= margin - 1e-6
            assert np.min([aspect, 1.0] - stretched) >= margin - 1e-6
        again = atlas_refine.refine(*arrays[:3], result.corner_uvs, uv_density=density, **options)
        assert again.intervention == "unchanged"
    filled = atlas_refine.refine(*arrays, uv_density=1.2 * size(full), **options)
    assert np.array_equal(filled.corner_uvs, full.corner_uvs)


@pytest.mark.parametrize("origin", [(0.0, 0.0), (9.0, 9.0), (0.0, 99.0)])
def test_small_shares_of_far_tiles_have_the_density_that_is_asked(origin):
    positions, offsets, corners, uvs = shapes.loose()
    groups, origins = np.zeros(len(offsets) - 1, dtype=np.int32), np.array([origin])
    tile = {"groups": groups, "group_origins": origins, "box_aspect": 1.0, "in_texture": True, "stored": "float32"}
    uvs = uvs / np.abs(uvs).max() + origins
    area = sum(chart.area for chart in atlas_refine.refine(positions, offsets, corners, uvs, **tile).charts)
    for share in (0.01, 0.003, 0.001, 0.0001):
        options = {"uv_density": np.sqrt(share / area), **tile}
        result = atlas_refine.refine(positions, offsets, corners, uvs, **options)
        assert result.bound_met
        assert result.after.pe_fixed_aspect == pytest.approx(share, rel=1e-3)
        again = atlas_refine.refine(positions, offsets, corners, result.corner_uvs, **options)
        assert again.intervention == "unchanged"


def test_many_charts_smaller_than_the_margin_keep_it_at_their_density_without_bending():
    margin, count = 32 / 1024, 49
    quads = [shapes.grid(1, 1, origin=(1.5 * (k % 7), 1.5 * (k // 7))) for k in range(count)]
    arrays = shapes.join(*quads)
    for pixels in (24.0, 64.0):
        density = pixels / 1024
        options = {"box_aspect": 1.0, "in_texture": True, "gap": margin, "gap_unit": "long_side", "stacks": "separate"}
        result = atlas_refine.refine(*arrays, uv_density=density, stored="float32", **options)
        assert result.intervention == "moved"
        assert uv_area(arrays, result.corner_uvs) == pytest.approx(count * density**2, rel=1e-4)
        own = atlas_refine.measure(*arrays[:3], result.corner_uvs, box_aspect=1.0, in_texture=True)
        assert own.gap_between * np.hypot(own.box_width, own.box_height) >= margin * (1 - 1e-6)
        assert result.corner_uvs.min() >= margin * (1 - 1e-6)


def test_a_gap_too_large_for_a_free_box_is_told():
    result = atlas_refine.refine(*shapes.loose(), pe_bound=0.4, uv_density=1e-3, gap=0.01, gap_unit="long_side")
    assert any("is more than a tenth" in warning for warning in result.warnings)


def test_keep_shape_moves_and_never_bends():
    arrays = shapes.loose()
    result = atlas_refine.refine(*arrays, pe_bound=0.8, keep_shape=faces_of(0, 1))
    assert [chart.fate for chart in result.charts] == ["kept", "refined", "refined"]
    before, after = arrays[3][corners_of(0, 48)], result.corner_uvs[corners_of(0, 48)]
    sides = [np.linalg.norm(uvs - np.roll(uvs, 1, axis=0), axis=1) for uvs in (before, after)]
    assert sides[1] / sides[1].sum() == pytest.approx(sides[0] / sides[0].sum(), rel=1e-9)


def test_locked_charts_stay_to_the_bit():
    positions, offsets, corners, uvs = shapes.loose()
    uvs = uvs / 30
    locked = faces_of(48, 84)
    result = atlas_refine.refine(positions, offsets, corners, uvs, pe_bound=0.5, locked=locked, best_effort=True)
    assert result.charts[1].fate == "locked"
    assert np.array_equal(result.corner_uvs[corners_of(48, 84)], uvs[corners_of(48, 84)])
    assert not np.array_equal(result.corner_uvs[corners_of(0, 48)], uvs[corners_of(0, 48)])
    assert result.corner_uvs.min() >= 0
    assert result.corner_uvs.max() <= 1


def test_no_seam_edges_stay_whole_and_preferred_ones_are_cut_more():
    arrays = shapes.join(shapes.grid(16, 4, bend=4.0))
    options = dict(FAST, cut="edges", pe_bound=0.7)
    free = seams_of(atlas_refine.refine(*arrays, **options))
    assert free
    ring = sorted(free)[: len(free) // 2]
    kept = atlas_refine.refine(*arrays, **options, no_seam=ring, best_effort=True)
    assert not seams_of(kept) & set(ring)
    column = [(17 * j + 7, 17 * (j + 1) + 7) for j in range(4)]
    assert not free & set(column)
    preferred = seams_of(atlas_refine.refine(*arrays, **options, prefer_seam=column))
    assert len(preferred & set(column)) > len(free & set(column))


def test_the_callers_triangles_are_the_surface():
    """A pentagon that is not flat is another surface under another division."""
    turn = 2 * np.pi * np.arange(5) / 5
    positions = np.column_stack([np.cos(turn), np.sin(turn), [0.6, 0.0, 0.0, 0.0, 0.0]])
    arrays = positions, [0, 5], [0, 1, 2, 3, 4], positions[:, :2]
    divisions = [[0, 1, 2], [0, 2, 3], [0, 3, 4]], [[1, 2, 3], [1, 3, 4], [1, 4, 0]]
    fan, other = (atlas_refine.refine(*arrays, pe_bound=0.3, triangles=division).before.distortion for division in divisions)
    assert fan == atlas_refine.refine(*arrays, pe_bound=0.3).before.distortion
    assert other != pytest.approx(fan, rel=1e-3)
    with pytest.raises(atlas_refine.AtlasRefineError, match="triangle 0 does not have three corners of one face"):
        atlas_refine.refine(*arrays, pe_bound=0.3, triangles=[[0, 1, 9]])


def test_relax_goes_on_to_the_least_distortion_under_the_bound():
    arrays = shapes.loose()
    plain, relaxed = (atlas_refine.refine(*arrays, pe_bound=0.6, relax=relax) for relax in (False, True))
    assert (plain.intervention, relaxed.intervention) == ("moved", "squeezed")
    assert relaxed.after.pe >= 0.6
    assert relaxed.after.distortion < plain.after.distortion


def uv_area(arrays, uvs):
    """Of quads."""
    u, v = np.moveaxis(uvs.reshape(-1, 4, 2), 2, 0)
    return 0.5 * np.sum(u * np.roll(v, -1, axis=1) - np.roll(u, -1, axis=1) * v)


def test_a_free_box_takes_the_density_that_is_asked():
    arrays = shapes.loose()
    plain = atlas_refine.refine(*arrays, pe_bound=0.8, stored="float32")
    for density in (0.01, 7.0):
        result = atlas_refine.refine(*arrays, pe_bound=0.8, uv_density=density, stored="float32")
        assert result.after.pe >= 0.8
        assert np.sqrt(uv_area(arrays, result.corner_uvs) / sum(chart.area for chart in result.charts)) == pytest.approx(density)
        assert result.after.distortion == pytest.approx(plain.after.distortion, rel=1e-5)
        assert result.corner_uvs.min() >= 0
        again = atlas_refine.refine(*arrays[:3], result.corner_uvs, pe_bound=0.8, uv_density=density, stored="float32")
        assert again.intervention == "unchanged"
        other = atlas_refine.refine(*arrays[:3], result.corner_uvs, pe_bound=0.8, uv_density=2 * density)
        assert other.intervention == "moved"
        assert other.corner_uvs == pytest.approx(2 * result.corner_uvs, rel=1e-5, abs=1e-6 * result.corner_uvs.max())
    for other in ({"box_aspect": 1.0}, {"locked": faces_of(0, 48)}, {"in_texture": True, "locked": faces_of(0, 48)}):
        with pytest.raises(atlas_refine.AtlasRefineError, match="needs a free box"):
            atlas_refine.refine(*arrays, uv_density=1.0, **other)
