"""addon/core: what the overlay draws, without Blender."""

import atlas_refine
import numpy as np
import pytest
import shapes
from core import borders, heat
from core.atlas import AtlasArrays
from core.overlay import Look, Source, picture_of

NONE = np.zeros((0, 2), dtype=int)
ALL = ("stretch", "seams", "gap")


def make_atlas(arrays):
    positions, offsets, corners, uvs = arrays
    return AtlasArrays(positions.astype(np.float32), offsets.astype(np.int32), corners.astype(np.int32), uvs.astype(np.float32))


def triangles_of_quads(atlas):
    first = atlas.face_offsets[:-1]
    return np.concatenate([first[:, None] + [0, 1, 2], first[:, None] + [0, 2, 3]]).astype(np.int32)


def source(arrays, scale=1.0, seams=NONE, shown=None, boxes=None, evaluated=None):
    atlas = make_atlas(arrays)
    boxes = np.zeros(len(atlas.face_offsets) - 1, dtype=int) if boxes is None else boxes
    return Source(atlas, triangles_of_quads(atlas), scale, seams, boxes, shown, evaluated)


def look(layers=ALL, **more):
    given = {
        "texture_sizes": ((100, 100),),
        "margin_px": 4.0,
        "to_border": False,
        "keeps_stacks": True,
        "low": (0.0, 0.0, 1.0),
        "high": (1.0, 1.0, 0.0),
        "worst": 2.0,
        "opacity": 0.5,
    }
    return Look(layers=layers, **{**given, **more})


def squares(*corners):
    """A grid of 2 x 2 quads, 0.2 wide, at each place of the UV map."""
    return shapes.join(*(shapes.grid(2, 2, corner, 0.1) for corner in corners))


def near_share(*sources, **more):
    """The part of border edges that are drawn as too near."""
    pictures = picture_of(atlas_refine, list(sources), look(("gap",), **more))
    edges = sum(len(borders.border_corners(source.atlas)) for source in sources)
    return sum(len(picture.lines["gap"]["uv"]) for picture in pictures) / 2 / edges


def test_stretch_is_the_engines():
    long, square = shapes.grid(4, 4), shapes.grid(3, 3, origin=(20.0, 0.0))
    arrays = shapes.join((long[0], long[1], long[2] * [3.0, 1.0]), square)
    one = source(arrays)
    corners, _ = heat.all_triangles(one.atlas.face_offsets, one.larger)
    values = heat.stretch(arrays[0][arrays[2][corners]], arrays[3][corners])
    assert values.max() == pytest.approx(atlas_refine.measure(*arrays).stretch_max)
    assert 1.0 <= values.min() < values.max()


def test_an_even_scale_is_no_stretch_and_twice_as_long_is_two():
    positions = np.array([[[0.0, 0, 0], [2, 0, 0], [0, 2, 0]]])
    uvs = np.array([[[0.0, 0], [1, 0], [0, 1]]])
    assert heat.stretch(positions, 7 * uvs) == pytest.approx([1.0])
    assert heat.stretch(positions, -uvs) == pytest.approx([1.0])  # turned, and mirrored:
    assert heat.stretch(positions, uvs * [-1, 1]) == pytest.approx([1.0])
    assert heat.stretch(positions, uvs * [4, 1]) == pytest.approx([2.0])  # one scale for all: twice and half
    assert heat.stretch(positions, 0 * uvs) == pytest.approx([heat.WORST])


def test_colours_go_from_low_to_high_and_stay():
    found = heat.colours(np.array([1.0, 2.0**0.5, 2.0, heat.WORST]), (0, 0, 1), (1, 1, 0), 2.0, 0.5)
    assert found.dtype == np.float32
    assert found == pytest.approx(np.array([[0, 0, 1, 0.5], [0.5, 0.5, 0.5, 0.5], [1, 1, 0, 0.5], [1, 1, 0, 0.5]]), abs=1e-6)


def test_a_face_is_coloured_as_a_whole():
    (picture,) = picture_of(atlas_refine, [source(shapes.loose())], look())
    count = 2 * (48 + 36 + 18)
    assert picture.colours["uv"].shape == (3 * count, 4)
    assert {place.shape for place in picture.faces.values()} == {(3 * count, 3)}
    halves = picture.colours["uv"].reshape(2, count // 2, 3, 4)
    assert np.array_equal(halves[0], halves[1])


def test_what_moves_the_vertices_moves_the_drawing_and_not_the_colours():
    plain = source(shapes.loose())
    bent = source(shapes.loose(), shown=plain.atlas.positions + np.float32([0.0, 0.0, 1.0]))
    (before,), (after,) = (picture_of(atlas_refine, [one], look()) for one in (plain, bent))
    assert all(np.array_equal(before.colours[where], after.colours[where]) for where in ("uv", "space"))
    assert np.array_equal(before.faces["uv"], after.faces["uv"])
    assert np.array_equal(before.faces["space"] + np.float32([0.0, 0.0, 1.0]), after.faces["space"])


def test_several_objects_are_stretched_as_one():
    """The second has twice the size in the world for the same UVs."""
    one, two = (source(shapes.join(shapes.grid(2, 2)), scale) for scale in (1.0, 2.0))
    alike = picture_of(atlas_refine, [one, one], look(("stretch",)))
    unlike = picture_of(atlas_refine, [one, two], look(("stretch",)))
    assert alike[0].colours["uv"][0, 0] == 0.0
    assert unlike[0].colours["uv"][0, 0] > 0.2


@pytest.mark.parametrize(("distance_px", "near"), [(4.1, False), (4.0, False), (3.9, True), (0.5, True)])
def test_charts_nearer_than_the_margin_are_drawn(distance_px, near):
    arrays = squares((0.1, 0.1), (0.3 + distance_px / 100, 0.1))
    share = near_share(source(arrays))
    assert share == (8 / 16 if near else 0)  # the two sides that face each other, and the edges that lead to them


def test_charts_of_two_objects_are_looked_at_as_well():
    left, right = source(squares((0.1, 0.1))), source(squares((0.32, 0.1)))
    assert near_share(left, right) == 8 / 16
    assert near_share(left, right, margin_px=0.0) == 0


def test_charts_in_textures_of_their_own_are_no_neighbours():
    both = squares((0.1, 0.1), (0.32, 0.1))
    assert near_share(source(both)) == 8 / 16
    assert near_share(source(both, boxes=np.repeat([0, 1], 4)), texture_sizes=((100, 100), (100, 100))) == 0
    near_border = source(both, boxes=np.repeat([0, 1], 4))
    share = near_share(near_border, texture_sizes=((100, 100), (100, 30)), to_border=True)
    assert share == 4 / 16  # 0.1 is 3 of 30 pixels


def test_stretch_is_that_of_each_texture():
    half = shapes.grid(4, 4, scale=0.1), shapes.grid(4, 4, scale=0.2, origin=(0.5, 0.0))
    arrays = shapes.join(*half)
    (one,) = picture_of(atlas_refine, [source(arrays)], look(("stretch",)))
    boxes = np.repeat([0, 1], 16)
    (two,) = picture_of(atlas_refine, [source(arrays, boxes=boxes)], look(("stretch",), texture_sizes=((64, 64), (32, 32))))
    assert one.colours["uv"][:, 0].max() > 0.3
    assert two.colours["uv"][:, 0].max() == pytest.approx(0, abs=1e-5)


def test_where_modifiers_make_other_faces_those_are_drawn_in_space():
    seen = source(shapes.join(shapes.grid(8, 8, scale=0.5)))
    cage = source(shapes.join(shapes.grid(4, 4)), evaluated=seen)
    (picture,) = picture_of(atlas_refine, [cage], look(("stretch",)))
    assert {where: len(points) for where, points in picture.faces.items()} == {"uv": 3 * 2 * 16, "space": 3 * 2 * 64}
    assert {where: len(colours) for where, colours in picture.colours.items()} == {"uv": 3 * 2 * 16, "space": 3 * 2 * 64}


def test_charts_that_overlap_are_near_and_stacks_are_not():
    overlapping = source(squares((0.1, 0.1), (0.15, 0.17)))
    stacked = source(squares((0.1, 0.1), (0.1, 0.1)))
    assert near_share(overlapping) > 0
    assert near_share(stacked) == 0
    assert near_share(stacked, keeps_stacks=False) == 1


@pytest.mark.parametrize("tile", [0.0, 3.0])
def test_the_border_of_the_tile_counts_where_the_margin_holds_there(tile):
    arrays = squares((0.02 + tile, 0.3))
    assert near_share(source(arrays), to_border=True) == 4 / 8  # the left side, and the edges that lead to it
    assert near_share(source(arrays)) == 0


def test_near_others_finds_what_a_plain_search_does():
    rng = np.random.default_rng(5)
    start = rng.uniform(0, 100, (300, 1, 2))
    ends = np.concatenate([start, start + rng.normal(0, 4, (300, 1, 2))], axis=1)
    charts = rng.integers(0, 40, 300)
    a, b = np.triu_indices(300, 1)
    close = (borders.distances(ends[a], ends[b]) < 2.0) & (charts[a] != charts[b])
    plain = np.zeros(300, dtype=bool)
    plain[a[close]] = plain[b[close]] = True
    assert 30 < plain.sum() < 300
    assert np.array_equal(borders.near_others(ends, charts, 2.0), plain)


def test_new_seams_are_drawn_on_both_sides_in_the_uv_map():
    arrays = shapes.join(shapes.grid(2, 1))
    inner = np.array([[1, 4]])  # of vertices 0 1 2 / 3 4 5
    (picture,) = picture_of(atlas_refine, [source(arrays, seams=inner)], look(("seams",)))
    lines = picture.lines["seams"]
    assert len(lines["uv"]) == len(lines["space"]) == 2 * 2
    assert {tuple(place) for place in lines["space"]} == {tuple(arrays[0][v]) for v in inner[0]}


def test_uvs_that_are_no_numbers_are_left_out():
    arrays = squares((0.1, 0.1), (0.32, 0.1))
    arrays[3][0] = np.nan
    (picture,) = picture_of(atlas_refine, [source(arrays)], look())
    assert len(picture.lines["gap"]["uv"]) == 2 * 8
