"""refine(seams="rectangles"): the cut mesh as arrays, against the mesh it was cut from."""

import itertools

import atlas_refine
import numpy as np
import pytest
import shapes
from test_refine import packing_efficiency

FAST = {"seams": "rectangles", "candidates": 40}


def cut(arrays=None, **options):
    arrays = shapes.loose() if arrays is None else arrays
    return arrays, atlas_refine.refine(*arrays, **FAST, **options)


def new_positions(arrays, mesh):
    """Positions of all vertices of the cut mesh."""
    positions, _, corner_vertices, _ = arrays
    corners = positions[corner_vertices[mesh.new_vertex_corners]]
    return np.concatenate([positions, np.einsum("vk,vkd->vd", mesh.new_vertex_weights, corners)])


def face_areas(positions, offsets, corners):
    """Of faces in the plane z = 0."""
    areas = []
    for begin, end in itertools.pairwise(offsets):
        x, y, _ = positions[corners[begin:end]].T
        areas.append(0.5 * np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y))
    return np.array(areas)


def test_the_bound_is_met_and_the_arrays_fit_together():
    arrays, result = cut(pe_bound=0.8)
    mesh = result.cut
    assert result.intervention == "cut"
    assert {array.dtype for array in (mesh.face_offsets, mesh.corner_vertices, mesh.face_sources)} == {np.dtype(np.int32)}
    assert {array.dtype for array in (mesh.corner_sources, mesh.new_vertex_corners, mesh.new_seams)} == {np.dtype(np.int32)}
    assert mesh.corner_weights.dtype == mesh.new_vertex_weights.dtype == np.float64
    assert mesh.face_offsets.shape == (len(mesh.face_sources) + 1,)
    assert mesh.face_offsets[-1] == len(mesh.corner_vertices) == len(result.corner_uvs)
    assert mesh.corner_sources.shape == mesh.corner_weights.shape == (len(mesh.corner_vertices), 3)
    assert mesh.new_vertex_corners.shape == mesh.new_vertex_weights.shape == (len(mesh.new_vertex_corners), 3)
    assert mesh.new_seams.shape[1] == 2
    assert len(mesh.new_seams) > 0
    assert mesh.corner_vertices.max() == len(arrays[0]) + len(mesh.new_vertex_corners) - 1
    assert packing_efficiency(mesh.face_offsets, result.corner_uvs) >= 0.8
    validity = atlas_refine.validate(new_positions(arrays, mesh), mesh.face_offsets, mesh.corner_vertices, result.corner_uvs)
    assert validity.valid, validity.problem


def test_new_vertices_lie_on_their_faces_and_pieces_tile_them():
    arrays, result = cut()
    mesh = result.cut
    corner_faces = np.repeat(np.arange(len(arrays[1]) - 1), np.diff(arrays[1]))
    assert np.all(np.ptp(corner_faces[mesh.new_vertex_corners], axis=1) == 0)
    assert mesh.new_vertex_weights.min() >= 0
    assert mesh.new_vertex_weights.sum(axis=1) == pytest.approx(1.0)
    assert np.array_equal(np.unique(mesh.face_sources), np.arange(len(arrays[1]) - 1))
    assert np.all(np.diff(mesh.face_sources) >= 0)
    pieces = face_areas(new_positions(arrays, mesh), mesh.face_offsets, mesh.corner_vertices)
    assert pieces.min() > 0
    tiled = np.bincount(mesh.face_sources, weights=pieces)
    assert tiled == pytest.approx(face_areas(arrays[0], arrays[1], arrays[2]), abs=1e-9)


def test_corners_are_means_of_corners_of_their_own_face():
    arrays, result = cut()
    mesh = result.cut
    faces = np.repeat(mesh.face_sources, np.diff(mesh.face_offsets))[:, None]
    assert np.all((mesh.corner_sources >= arrays[1][faces]) & (mesh.corner_sources < arrays[1][faces + 1]))
    assert mesh.corner_weights.min() >= 0
    assert mesh.corner_weights.sum(axis=1) == pytest.approx(1.0, abs=1e-12)
    means = np.einsum("ck,ckd->cd", mesh.corner_weights, arrays[0][arrays[2][mesh.corner_sources]])
    assert means == pytest.approx(new_positions(arrays, mesh)[mesh.corner_vertices], abs=1e-12)
    old = mesh.corner_vertices < len(arrays[0])
    assert np.all(mesh.corner_weights[old] == [1.0, 0.0, 0.0])
    assert np.array_equal(arrays[2][mesh.corner_sources[old]], np.repeat(mesh.corner_vertices[old][:, None], 3, axis=1))
    assert not np.all(old)


def test_a_result_outlives_its_arrays_and_shows_its_figures():
    _, result = cut()
    mesh = result.cut
    offsets = mesh.face_offsets
    del result
    assert np.array_equal(mesh.face_offsets, offsets)
    assert {"face_offsets", "corner_vertices", "face_sources", "new_seams"} < set(mesh.as_dict())
    _, result = cut()
    assert result.rectangles.trails > 0
    assert repr(result.rectangles).startswith("RectangleReport(tutte_charts=")
    assert atlas_refine.refine(*shapes.loose()).rectangles is None


def test_one_seed_gives_the_same_bits_on_any_number_of_threads():
    first = cut(seed=3, threads=1)[1]
    second = cut(seed=3, threads=2)[1]
    assert first.corner_uvs.tobytes() == second.corner_uvs.tobytes()
    for name in first.cut.as_dict():
        assert getattr(first.cut, name).tobytes() == getattr(second.cut, name).tobytes(), name


def test_importance_has_one_positive_number_for_each_face():
    arrays = shapes.loose()
    faces = len(arrays[1]) - 1
    for importance in (np.ones(faces - 1), np.zeros(faces), np.full(faces, -1.0), np.full(faces, np.nan)):
        with pytest.raises(atlas_refine.AtlasRefineError, match="importance") as caught:
            atlas_refine.refine(*arrays, importance=importance)
        assert caught.value.code == "bad_option"
    heavy = np.ones(faces)
    heavy[:10] = 100.0
    even = atlas_refine.refine(*arrays, importance=np.ones(faces, dtype=np.int64)).corner_uvs
    assert even.tobytes() == atlas_refine.refine(*arrays).corner_uvs.tobytes()
    assert atlas_refine.refine(*arrays, importance=heavy).corner_uvs.tobytes() != even.tobytes()


@pytest.mark.parametrize("option", [{"sigma": 0.02}, {"until_input": True}, {"reference": "input"}])
def test_options_arrive(option):
    plain = cut()[1]
    assert cut(**option)[1].corner_uvs.tobytes() != plain.corner_uvs.tobytes()


def test_a_stacked_chart_is_cut_like_its_leader_also_along_a_seam_with_another_chart():
    """Half a bent sheet, the other half, and a copy of that elsewhere in space on it in the UVs."""
    positions, faces, uvs = shapes.grid(24, 6, bend=3.0)
    upper = np.arange(len(faces)) >= 72
    corner_uvs = uvs[faces] + 30.0 * upper[:, None, None]
    arrays = (
        np.concatenate([positions, positions + [0.0, 40.0, 0.0]]),
        np.arange(0, 4 * (144 + 72) + 1, 4),
        np.concatenate([faces, faces[upper] + len(positions)]).ravel(),
        np.concatenate([corner_uvs, corner_uvs[upper]]).reshape(-1, 2),
    )
    _, result = cut(arrays)
    mesh = result.cut
    assert [chart.fate for chart in result.charts] == ["refined", "refined", "stacked"]
    ends = np.cumsum(np.diff(mesh.face_offsets)[mesh.face_sources < 144])[-1]
    places = new_positions(arrays, mesh)[mesh.corner_vertices]
    begin = np.searchsorted(mesh.face_sources, 72)
    leader = places[mesh.face_offsets[begin] : ends]
    assert places[ends:] == pytest.approx(leader + [0.0, 40.0, 0.0], abs=1e-9)
    assert np.array_equal(result.corner_uvs[ends:], result.corner_uvs[mesh.face_offsets[begin] : ends])
