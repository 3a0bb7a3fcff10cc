"""Bad arguments: one exception type for the data, TypeError for what is no argument at all, never a crash."""

import atlas_refine
import numpy as np
import pytest
import shapes


def refuse(arrays, **options):
    with pytest.raises(atlas_refine.AtlasRefineError) as caught:
        atlas_refine.refine(*arrays, **options)
    assert "\n" not in str(caught.value)
    return caught.value


def changed(index, change):
    arrays = [array.copy() for array in shapes.tight()]
    arrays[index] = change(arrays[index])
    return arrays


def put(index, value):
    def change(array):
        array[index] = value
        return array

    return change


@pytest.mark.parametrize("pe_bound", [0, 1, 1.2, -0.5, float("nan")])
def test_a_bound_out_of_range(pe_bound):
    error = refuse(shapes.tight(), pe_bound=pe_bound)
    assert error.code == "bad_option"
    assert (error.chart, error.face) == (-1, -1)


@pytest.mark.parametrize(
    "options",
    [
        {"gap": -0.1},
        {"gap": 0.5},
        {"gap": float("nan")},
        {"max_distortion": 0.5},
        {"max_stretch": 0.5},
        {"box_aspect": -1.0},
        {"box_aspect": 0.0099},
        {"box_aspect": 101.0},
        {"box_aspect": float("inf")},
        {"threads": -1},
        {"density": "even"},
        {"stored": "half"},
        {"seams": "many"},
        {"reference": "paper"},
        {"sigma": 0.0},
        {"sigma": -0.1},
        {"sigma": 0.2},
        {"sigma": float("nan")},
        {"candidates": 0},
        {"omega": 1.5},
        {"omega": -0.1},
        {"importance": "high"},
        {"importance": [[1.0] * 64]},
        {"importance": 2.0},
        {"gap": 0.01, "gap_unit": "px"},
    ],
)
def test_an_option_out_of_range_is_named(options):
    error = refuse(shapes.tight(), **options)
    assert error.code == "bad_option"
    assert next(iter(options)).split("_")[-1] in str(error).lower()


@pytest.mark.parametrize(
    ("arrays", "word"),
    [
        (changed(0, lambda a: a[:, :2]), "positions"),
        (changed(0, lambda a: a.astype(str)), "positions"),
        (changed(1, lambda a: a.astype(float)), "face_offsets"),
        (changed(2, lambda a: a.reshape(-1, 4)), "corner_vertices"),
        (changed(2, lambda a: a + 2**40), "corner_vertices"),
        (changed(3, lambda a: a.ravel()), "corner_uvs"),
        (changed(3, lambda a: None), "corner_uvs"),
    ],
)
def test_a_wrong_shape_or_type_names_the_array(arrays, word):
    error = refuse(arrays)
    assert error.code == "bad_input"
    assert word in str(error)


@pytest.mark.parametrize(
    "arrays",
    [
        changed(1, put(-1, 10**6)),
        changed(1, put(1, 2)),
        changed(1, put(1, -4)),
        changed(1, lambda a: a[:0]),
        changed(1, lambda a: a[:1]),
        changed(2, put(5, 10**6)),
        changed(2, put(5, -1)),
        changed(3, lambda a: a[:-1]),
        [np.zeros((0, 3)), np.zeros(1, int), np.zeros(0, int), np.zeros((0, 2))],
    ],
)
@pytest.mark.parametrize("function", [atlas_refine.refine, atlas_refine.measure, atlas_refine.validate])
def test_arrays_that_do_not_fit_together(arrays, function):
    with pytest.raises(atlas_refine.AtlasRefineError) as caught:
        function(*arrays)
    assert caught.value.code == "bad_input"


NOT_FINITE = [changed(0, put((3, 1), np.nan)), changed(0, put((3, 1), np.inf)), changed(3, put((7, 0), np.nan))]


@pytest.mark.parametrize("arrays", NOT_FINITE)
@pytest.mark.parametrize("function", [atlas_refine.measure, atlas_refine.validate])
def test_what_is_not_finite_cannot_be_measured(arrays, function):
    with pytest.raises(atlas_refine.AtlasRefineError) as caught:
        function(*arrays)
    assert caught.value.code == "bad_input"


@pytest.mark.parametrize("arrays", NOT_FINITE)
def test_faces_that_are_not_finite_are_left_as_they_are(arrays):
    result = atlas_refine.refine(*arrays)
    left = [chart for chart in result.charts if chart.fate == "left"]
    assert left
    assert all("finite" in chart.reason for chart in left)
    not_finite = ~np.isfinite(arrays[3]).all(axis=1)
    assert result.corner_uvs[not_finite].tobytes() == np.asarray(arrays[3], dtype=np.float64)[not_finite].tobytes()


def test_where_no_face_is_finite_the_first_is_named():
    error = refuse(changed(3, lambda a: a * np.nan))
    assert error.face == 0
    assert error.stage


def test_a_flipped_face_is_mended_and_told_with_its_chart_and_face():
    positions, face_offsets, corner_vertices, corner_uvs = shapes.loose()
    vertex = corner_vertices[4 * (12 * 4 + 14) + 2]  # inside the second chart
    corner_uvs[corner_vertices == vertex] += [3.0, 0.0]
    result = atlas_refine.refine(positions, face_offsets, corner_vertices, corner_uvs)
    (repair,) = result.repairs
    assert repair.charts == [1]
    assert repair.faces
    assert min(repair.faces) >= 12 * 4
    assert str(repair.faces[0]) in repair.text


@pytest.mark.parametrize(
    "options",
    [{"bound": 0.8}, {"pe_bound": "high"}, {"pe_bound": None}, {"seed": -1}, {"progress": 3}, {"threads": 1.5}, {"name": 1}]
    + [{"candidates": 2.5}, {"sigma": "wide"}, {"until_input": "yes"}],
)
def test_what_is_no_argument_at_all_is_a_type_error(options):
    with pytest.raises(TypeError, match=next(iter(options))):
        atlas_refine.refine(*shapes.tight(), **options)


def test_measure_takes_no_refine_options():
    with pytest.raises(TypeError, match="pe_bound"):
        atlas_refine.measure(*shapes.tight(), pe_bound=0.8)
