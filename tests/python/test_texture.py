"""in_texture: the box is the texture, in the input too, and the gap holds to its border. charts_of_faces(), find_problems() and
group_by_tile()."""

import atlas_refine
import numpy as np
import pytest
import shapes


def in_texture(arrays, **more):
    return atlas_refine.refine(*arrays, in_texture=True, stored="float32", **more)


def fill(share, origin=(0.0, 0.0)):
    """One square chart of that side, at the origin of the texture or elsewhere."""
    positions, offsets, corners, uvs = shapes.tight()
    return positions, offsets, corners, uvs / 8 * share + origin


def test_what_fills_its_own_box_but_not_the_texture_does_not_hold_the_bound():
    assert atlas_refine.refine(*fill(0.5), pe_bound=0.9).intervention == "unchanged"
    result = in_texture(fill(0.5), pe_bound=0.9)
    assert result.before.pe_fixed_aspect == pytest.approx(0.25)
    assert result.after.pe_fixed_aspect >= 0.9
    assert result.corner_uvs.min() >= 0.0
    assert result.corner_uvs.max() <= 1.0


def test_what_lies_outside_of_the_texture_does_not_hold_the_bound():
    assert in_texture(fill(1.0), pe_bound=0.9).intervention == "unchanged"
    assert in_texture(fill(1.0, origin=(3.0, 0.0)), pe_bound=0.9).intervention != "unchanged"


@pytest.mark.parametrize("aspect", [1.0, 2.0, 0.5])
@pytest.mark.parametrize("seams", ["none", "rectangles"])
def test_the_gap_is_kept_to_the_border(aspect, seams):
    pixels, longer = 4, 256
    options = {"box_aspect": aspect, "gap": pixels / longer, "gap_unit": "long_side", "seams": seams}
    result = in_texture(shapes.loose(), pe_bound=0.75, **options)
    assert result.after.pe_fixed_aspect >= 0.75
    texture = np.array([aspect, 1.0]) / max(aspect, 1.0) * longer  # in pixels
    low, high = result.corner_uvs * texture, (1 - result.corner_uvs) * texture
    assert low.min() >= pixels
    assert high.min() >= pixels
    assert min(low.min(), high.min()) < pixels + 0.01
    again = atlas_refine.measure(*measured(result), box_aspect=aspect, in_texture=True)
    assert again.pe_fixed_aspect == pytest.approx(result.after.pe_fixed_aspect)


def measured(result):
    positions, offsets, corners, _ = shapes.loose()
    if result.cut is None:
        return positions, offsets, corners, result.corner_uvs
    vertices = [
        (positions[corners[three]] * weights[:, None]).sum(axis=0)
        for three, weights in zip(result.cut.new_vertex_corners, result.cut.new_vertex_weights, strict=True)
    ]
    all_positions = np.concatenate([positions, np.array(vertices).reshape(-1, 3)])
    return all_positions, result.cut.face_offsets, result.cut.corner_vertices, result.corner_uvs


def test_a_second_run_changes_nothing():
    options = {"pe_bound": 0.8, "gap": 4 / 512, "gap_unit": "long_side", "box_aspect": 1.0}
    first = in_texture(shapes.loose(), **options)
    again = in_texture((*shapes.loose()[:3], first.corner_uvs), **options)
    assert again.intervention == "unchanged"
    assert np.array_equal(again.corner_uvs, first.corner_uvs)


def test_the_border_is_kept_around_locked_charts_too():
    positions, offsets, corners, uvs = shapes.join(shapes.grid(4, 4, origin=(0.0, 0.0), scale=0.1), shapes.grid(9, 6, bend=1.5))
    locked = np.arange(len(offsets) - 1) < 16
    result = in_texture((positions, offsets, corners, uvs), pe_bound=0.6, gap=8 / 256, gap_unit="long_side", locked=locked)
    assert np.array_equal(result.corner_uvs[:64], uvs[:64])
    free = result.corner_uvs[64:]
    assert min(free.min(), (1 - free).min()) >= 8 / 256


def test_a_gap_that_is_pressed_to_its_last_survives_single_precision():
    positions, offsets, corners, uvs = shapes.loose()
    uvs = (uvs / 30).astype(np.float32).astype(np.float64)
    options = {"pe_bound": 0.6, "gap": 4 / 2048, "gap_unit": "long_side", "density": "keep"}
    options["locked"] = np.repeat([False, True, False], [48, 36, 18])
    result = in_texture((positions, offsets, corners, uvs), **options)
    assert result.after.pe_fixed_aspect >= 0.6
    again = in_texture((positions, offsets, corners, result.corner_uvs), **options)
    assert again.intervention == "unchanged"


def test_a_border_that_leaves_less_than_the_bound_is_refused():
    with pytest.raises(atlas_refine.AtlasRefineError, match="border") as caught:
        in_texture(shapes.loose(), pe_bound=0.8, gap=0.08, gap_unit="long_side")
    assert caught.value.code == "bound_not_reached"


def many(count, origin=(0.0, 0.0)):
    """Rectangles of 1 to 6 quads a side."""
    rng = np.random.default_rng(1)
    sides = [tuple(int(side) for side in rng.integers(1, 7, 2)) for _ in range(count)]
    return shapes.join(*(shapes.grid(*side, origin=(8.0 * (k % 20), 8.0 * (k // 20))) for k, side in enumerate(sides)))


def test_charts_whose_size_leaves_room_for_a_wide_gap_are_only_moved():
    """Grown by the gap they take .86 of the texture, and have no more of it than they need."""
    arrays = many(220)
    pixels, size, share = 31, 1024, 0.2
    density = (share / (len(arrays[1]) - 1)) ** 0.5
    gap = {"gap": pixels / size, "gap_unit": "long_side"}
    result = in_texture(arrays, pe_bound=0.8, uv_density=density, box_aspect=1.0, **gap)
    assert result.intervention == "moved"
    assert result.after.pe_fixed_aspect == pytest.approx(share, rel=1e-4)
    assert min(result.corner_uvs.min(), (1 - result.corner_uvs).min()) * size >= pixels
    assert result.after.distortion == pytest.approx(1.0)


def test_a_gap_without_room_at_the_bound_is_refused_by_what_can_be_had():
    arrays = many(220)
    with pytest.raises(
        atlas_refine.AtlasRefineError, match="220 charts at the bound 0.8: with it they cover less than 0.6"
    ) as caught:
        in_texture(arrays, pe_bound=0.8, gap=16 / 1024, gap_unit="long_side", box_aspect=1.0)
    assert caught.value.code == "bound_not_reached"


def test_charts_of_faces_are_the_reports():
    positions, offsets, corners, uvs = shapes.loose()
    charts = atlas_refine.charts_of_faces(positions, offsets, corners, uvs)
    assert np.array_equal(charts, np.repeat([0, 1, 2], [48, 36, 18]))
    assert [chart.faces for chart in atlas_refine.refine(positions, offsets, corners, uvs).charts] == np.bincount(charts).tolist()
    groups = np.zeros(102, dtype=int)
    groups[:24] = 1
    assert np.array_equal(
        atlas_refine.charts_of_faces(positions, offsets, corners, uvs, groups=groups), np.repeat([0, 1, 2, 3], [24, 24, 36, 18])
    )


def test_problems_face_by_face():
    positions, offsets, corners, uvs = shapes.loose()
    problems = atlas_refine.find_problems(positions, offsets, corners, uvs)
    assert all(len(faces) == 0 for faces in problems.values())
    uvs = uvs.copy()
    third = slice(4 * 84, 4 * 102)
    first_face = uvs[offsets[48] : offsets[49]].mean(axis=0)
    uvs[third] = (uvs[third] - uvs[third].mean(axis=0)) * 0.01 + first_face  # a small chart within one face of the second
    uvs[: 4 * 48] *= [-1, 1]
    problems = atlas_refine.find_problems(positions, offsets, corners, uvs)
    assert problems["overlapping"].tolist() == [48, *range(84, 102)]
    assert problems["mirrored"].tolist() == list(range(48))
    assert problems["flipped"].tolist() == []
    uvs[third] = 0.5
    uvs[5] = np.nan
    problems = atlas_refine.find_problems(positions, offsets, corners, uvs)
    assert problems["unwrapped"].tolist() == [1, *range(84, 102)]


def test_a_face_turned_over_within_its_chart_is_flipped_and_overlaps():
    positions, offsets, corners, uvs = shapes.join(shapes.grid(4, 4))
    uvs = uvs.copy()
    uvs[corners == 12] = [4.6, 2.6]  # an inner vertex beyond the chart's border
    problems = atlas_refine.find_problems(positions, offsets, corners, uvs)
    assert len(problems["flipped"]) > 0
    assert set(problems["flipped"]) <= set(problems["overlapping"])


def test_charts_side_by_side_do_not_overlap():
    arrays = shapes.join(shapes.grid(4, 4), shapes.grid(4, 4, origin=(4.0, 0.0)))
    assert len(atlas_refine.find_problems(*arrays)["overlapping"]) == 0


def test_tiles_are_groups():
    arrays = shapes.join(shapes.grid(2, 2, scale=0.2), shapes.grid(2, 2, scale=0.2, origin=(1.3, 2.1)))
    groups, origins, names = atlas_refine.group_by_tile(*arrays)
    assert groups.tolist() == [0] * 4 + [1] * 4
    assert origins.tolist() == [[0, 0], [1, 2]]
    assert names == ["1001", "1022"]
