"""measure() and validate() on atlases whose figures are known."""

import atlas_refine
import numpy as np
import pytest
import shapes


def test_a_square_that_fills_its_box():
    measures = atlas_refine.measure(*shapes.tight())
    assert measures.unit_square_share == pytest.approx(64.0)
    assert measures.pe == pytest.approx(1.0)
    assert measures.distortion == pytest.approx(1.0)
    assert measures.distortion_to_input == pytest.approx(1.0)
    assert (measures.chart_count, measures.small_charts, measures.seam_edges) == (1, 0, 0)
    assert measures.gap_between == np.inf


def test_a_fixed_aspect_has_a_box_of_its_own():
    arrays = shapes.join(shapes.grid(8, 2))
    measures = atlas_refine.measure(*arrays, box_aspect=1.0)
    assert measures.pe == pytest.approx(1.0)
    assert measures.pe_fixed_aspect == pytest.approx(0.25)
    assert atlas_refine.measure(*arrays).pe_fixed_aspect == pytest.approx(1.0)


@pytest.mark.parametrize("aspect", [-1.0, 0.0099, 101.0, float("inf"), float("nan")])
def test_an_aspect_out_of_range_is_refused(aspect):
    with pytest.raises(atlas_refine.AtlasRefineError, match=r"aspect must be 0 \(free\) or lie in \[0.01, 100\]"):
        atlas_refine.measure(*shapes.tight(), box_aspect=aspect)


def test_two_squares_and_the_gap_between_them():
    arrays = shapes.join(shapes.grid(3, 3), shapes.grid(3, 3, origin=(4.0, 0.0)))
    measures = atlas_refine.measure(*arrays)
    assert measures.chart_count == 2
    assert measures.pe == pytest.approx(18 / 21)
    assert measures.gap_between == pytest.approx(1 / np.hypot(7, 3))


def test_a_valid_atlas_a_flipped_one_and_one_that_overlaps():
    arrays = shapes.loose()
    assert atlas_refine.validate(*arrays).valid
    assert atlas_refine.validate(*arrays).problem == ""

    mirrored = arrays[3] * [-1.0, 1.0]
    validity = atlas_refine.validate(*arrays[:3], mirrored)
    assert not validity.valid
    assert validity.mirrored_charts == 3

    validity = atlas_refine.validate(*shapes.join(shapes.grid(3, 3), shapes.grid(3, 3, origin=(2.5, 0.5))))
    assert not validity.valid
    assert validity.crossings > 0
    assert validity.problem


def test_faces_are_divided_as_the_reader_does():
    positions = np.array([[0, 0, 0], [1, 0, 0], [2, 2, 0], [0, 1, 0]], dtype=float)
    uvs = np.array([[0, 0], [1, 0], [1, 1], [0, 1]], dtype=float)
    arrays = positions, [0, 4], [0, 1, 2, 3], uvs
    diagonals = {"fan": [[0, 1, 2], [0, 2, 3]], "other": [[0, 1, 3], [1, 2, 3]]}
    stretch = {name: atlas_refine.measure(*arrays, triangles=triangles).stretch_max for name, triangles in diagonals.items()}
    assert stretch["fan"] == atlas_refine.measure(*arrays).stretch_max
    assert stretch["other"] != pytest.approx(stretch["fan"], rel=0.05)
    refined = atlas_refine.refine(*arrays, pe_bound=0.5, triangles=diagonals["other"])
    assert stretch["other"] == pytest.approx(refined.before.stretch_max)
