"""refine(): arrays in, a valid atlas at the bound out, or one error."""

import itertools
import json
import threading
import time

import atlas_refine
import numpy as np
import pytest
import shapes


def uv_area(face_offsets, corner_uvs):
    """Sum of the faces' UV areas, by the shoelace formula."""
    area = 0.0
    for begin, end in itertools.pairwise(face_offsets):
        u, v = corner_uvs[begin:end].T
        area += 0.5 * np.sum(u * np.roll(v, -1) - np.roll(u, -1) * v)
    return area


def packing_efficiency(face_offsets, corner_uvs):
    return uv_area(face_offsets, corner_uvs) / np.prod(corner_uvs.max(axis=0) - corner_uvs.min(axis=0))


def test_an_atlas_at_the_bound_comes_back_bit_for_bit():
    arrays = shapes.tight()
    result = atlas_refine.refine(*arrays, pe_bound=0.9)
    assert result.intervention == "unchanged"
    assert result.cut is None
    assert result.bound_met
    assert result.corner_uvs.tobytes() == arrays[3].tobytes()


@pytest.mark.parametrize("pe_bound", [0.8, 0.9])
@pytest.mark.parametrize("density", ["equal", "keep"])
def test_the_bound_is_met_on_the_returned_values(pe_bound, density):
    positions, face_offsets, corner_vertices, corner_uvs = shapes.loose()
    result = atlas_refine.refine(positions, face_offsets, corner_vertices, corner_uvs, pe_bound=pe_bound, density=density)
    assert packing_efficiency(face_offsets, corner_uvs) < 0.5
    assert packing_efficiency(face_offsets, result.corner_uvs) >= pe_bound
    assert result.after.pe >= pe_bound
    assert result.intervention in ("moved", "squeezed")
    validity = atlas_refine.validate(positions, face_offsets, corner_vertices, result.corner_uvs)
    assert validity.valid, validity.problem
    assert result.after.seam_edges == result.before.seam_edges
    assert result.after.chart_count == 3 == len(result.charts)


def test_a_square_box():
    arrays = shapes.loose()
    result = atlas_refine.refine(*arrays, pe_bound=0.8, box_aspect=1.0)
    assert result.after.pe_fixed_aspect >= 0.8
    side = max(result.after.box_width, result.after.box_height)
    assert uv_area(arrays[1], result.corner_uvs) / side**2 >= 0.8


def test_float32_values_are_what_was_certified():
    positions, face_offsets, corner_vertices, corner_uvs = shapes.loose()
    corner_uvs = corner_uvs.astype(np.float32)
    result = atlas_refine.refine(positions, face_offsets, corner_vertices, corner_uvs, stored="float32")
    stored = result.corner_uvs.astype(np.float32)
    assert np.array_equal(stored.astype(np.float64), result.corner_uvs)
    assert atlas_refine.validate(positions, face_offsets, corner_vertices, stored).valid
    assert packing_efficiency(face_offsets, stored.astype(np.float64)) >= 0.8


def test_a_stated_gap_is_kept_in_either_unit():
    arrays = shapes.loose()
    result = atlas_refine.refine(*arrays, gap=0.004)
    assert (result.gap.value, result.gap.unit) == (0.004, "diagonal")
    assert result.after.gap_between >= 0.004 * (1 - 1e-9)
    result = atlas_refine.refine(*arrays, gap=8 / 1024, gap_unit="long_side")
    assert (result.gap.value, result.gap.unit) == (8 / 1024, "long_side")
    diagonal = np.hypot(result.after.box_width, result.after.box_height)
    long_side = max(result.after.box_width, result.after.box_height)
    assert result.after.gap_between * diagonal >= 8 / 1024 * long_side * (1 - 1e-9)


def test_the_input_arrays_are_left_alone():
    arrays = shapes.loose()
    copies = [array.copy() for array in arrays]
    atlas_refine.refine(*arrays)
    for array, copy in zip(arrays, copies, strict=True):
        assert array.tobytes() == copy.tobytes()


def test_one_seed_gives_the_same_bits_on_any_number_of_threads():
    arrays = shapes.loose()
    first = atlas_refine.refine(*arrays, seed=3, threads=1).corner_uvs
    assert atlas_refine.refine(*arrays, seed=3, threads=1).corner_uvs.tobytes() == first.tobytes()
    assert atlas_refine.refine(*arrays, seed=3, threads=2).corner_uvs.tobytes() == first.tobytes()


def test_every_kind_of_numeric_array_is_taken():
    positions, face_offsets, corner_vertices, corner_uvs = shapes.tight()
    result = atlas_refine.refine(
        np.asfortranarray(positions.astype(np.float32)),
        face_offsets.astype(np.uint16),
        corner_vertices.tolist(),
        np.column_stack([corner_uvs, corner_uvs])[:, 2:],
    )
    assert result.corner_uvs.tobytes() == corner_uvs.tobytes()


def test_a_bound_out_of_reach_is_an_error_and_best_effort_is_not():
    arrays = shapes.loose()
    with pytest.raises(atlas_refine.AtlasRefineError) as caught:
        atlas_refine.refine(*arrays, pe_bound=0.999, gap=0.05)
    assert caught.value.code == "bound_not_reached"
    assert "packing efficiency" in str(caught.value)
    result = atlas_refine.refine(*arrays, pe_bound=0.999, gap=0.05, best_effort=True)
    assert not result.bound_met
    assert result.after.pe < 0.999
    assert atlas_refine.validate(*arrays[:3], result.corner_uvs).valid


def test_what_packing_efficiency_costs():
    arrays = shapes.loose()
    curve = atlas_refine.packing_curve(*arrays, bounds=(0.9, 0.6, 0.8, 0.999), gap=0.01)
    assert [bound for bound, _ in curve] == [0.6, 0.8, 0.9]
    distortion = [e_d for _, e_d in curve]
    assert distortion == sorted(distortion)
    last = atlas_refine.refine(*arrays, pe_bound=0.9, gap=0.01, relax=True)
    assert distortion[-1] == last.after.distortion


def test_progress_rises_and_other_threads_run_meanwhile():
    seen, ticks, stop = [], [0], threading.Event()

    def tick():
        while not stop.is_set():
            ticks[0] += 1
            time.sleep(0.001)

    thread = threading.Thread(target=tick)
    thread.start()
    try:
        atlas_refine.refine(*shapes.loose(), pe_bound=0.9, progress=seen.append)
    finally:
        stop.set()
        thread.join()
    fractions = [progress.fraction for progress in seen]
    assert fractions
    assert fractions == sorted(fractions)
    assert fractions[0] >= 0
    assert fractions[-1] <= 1
    assert all(isinstance(progress.stage, str) for progress in seen)
    assert ticks[0] > 1


def test_progress_that_returns_false_cancels():
    with pytest.raises(atlas_refine.AtlasRefineError) as caught:
        atlas_refine.refine(*shapes.loose(), progress=lambda progress: False)
    assert caught.value.code == "cancelled"


def test_what_progress_raises_comes_out():
    def fail(progress):
        raise KeyError("mine")

    with pytest.raises(KeyError, match="mine"):
        atlas_refine.refine(*shapes.loose(), progress=fail)


def test_a_result_shows_all_its_figures():
    result = atlas_refine.refine(*shapes.tight())
    fields = result.as_dict()
    assert {"corner_uvs", "cut", "intervention", "bound_met", "before", "after", "gap", "price", "iterations"} < set(fields)
    assert {"ended", "charts", "pieces", "repairs", "fallbacks", "warnings", "timings", "profile"} < set(fields)
    assert result.profile.phases["certificate"] > 0
    assert repr(result.after).startswith("Measures(pe=")
    with pytest.raises(AttributeError):
        result.after.pe = 1.0


@pytest.mark.parametrize("seams", ["none", "rectangles"])
def test_a_result_goes_through_json(seams):
    result = atlas_refine.refine(*shapes.loose(), seams=seams, candidates=40)
    fields = json.loads(json.dumps(result.as_dict(), allow_nan=False))
    assert fields == result.as_dict()
    assert np.array(fields["corner_uvs"]).tobytes() == result.corner_uvs.tobytes()
    assert fields["after"] == result.after.as_dict()
    assert fields["gap"] == {"value": result.gap.value, "unit": "diagonal"}
    assert [chart["faces"] for chart in fields["charts"]] == [chart.faces for chart in result.charts]
    assert (fields["cut"] is None) == (result.cut is None) == (seams == "none")
    if result.cut is not None:
        assert fields["rectangles"]["trails"] == result.rectangles.trails
        assert fields["cut"]["new_seams"] == result.cut.new_seams.tolist()
        assert len(fields["pieces"]) == len(result.pieces) == result.after.chart_count
        assert {piece.chart for piece in result.pieces} == {0, 1, 2}


def test_what_is_infinite_is_none_in_a_dict():
    measures = atlas_refine.measure(*shapes.tight())
    assert measures.gap_between == np.inf
    assert measures.as_dict()["gap_between"] is None
    assert measures.as_dict()["pe"] == measures.pe
