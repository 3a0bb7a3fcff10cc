"""addon/core: what the add-on does without Blender."""

import pathlib
import sys

import atlas_refine
import numpy as np
import pytest
import shapes

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "addon"))

from core.atlas import AtlasArrays, stored_uvs
from core.options import Options
from core.summary import figures, headline


def test_options_are_the_engines_keywords():
    result = atlas_refine.refine(*shapes.tight(), **Options(pe_bound=0.9).engine_arguments())
    assert result.intervention == "unchanged"


def test_a_float32_bound_becomes_the_decimal_that_was_typed():
    assert Options(pe_bound=float(np.float32(0.85))).engine_arguments()["pe_bound"] == 0.85


def test_the_gap_in_pixels_is_a_fraction_of_the_texture():
    arguments = Options(gap="PIXELS", gap_px=4, texture_size=1024).engine_arguments()
    assert (arguments["gap"], arguments["gap_unit"]) == (4 / 1024, "long_side")
    assert "gap" not in Options(gap="AUTO", gap_px=4).engine_arguments()


def test_the_aspect_and_the_density():
    assert Options(aspect="SQUARE").engine_arguments()["box_aspect"] == 1.0
    assert Options().engine_arguments()["box_aspect"] == 0.0
    assert Options().engine_arguments()["density"] == "keep"
    assert Options().engine_arguments()["stored"] == "float32"


def test_sigma_goes_with_rectangles_only():
    arguments = Options(seams="RECTANGLES", sigma=float(np.float32(0.004))).engine_arguments()
    assert (arguments["seams"], arguments["sigma"]) == ("rectangles", 0.004)
    arguments = Options(sigma=7.0).engine_arguments()
    assert (arguments["seams"], "sigma" in arguments) == ("none", False)


def test_uvs_that_float32_cannot_hold_are_refused():
    assert stored_uvs(np.array([[0.5, 0.25]])).dtype == np.float32
    with pytest.raises(ValueError, match="single precision"):
        stored_uvs(np.array([[0.1, 0.25]]))


def test_arrays_are_compared_bit_for_bit():
    positions, offsets, corners, uvs = shapes.tight()
    atlas = AtlasArrays(positions, offsets, corners, uvs)
    assert atlas.same_as(AtlasArrays(positions.copy(), offsets.copy(), corners.copy(), uvs.copy()))
    assert not atlas.same_as(AtlasArrays(positions, offsets, corners, np.nextafter(uvs, 9.0)))
    assert not atlas.same_as(AtlasArrays(positions[:-1], offsets, corners, uvs))


def test_the_words_of_a_result():
    result = atlas_refine.refine(*shapes.loose())
    assert "PE 0.167 -> 0.8" in headline(result)
    assert "E_d" in headline(result)
    rows = {name: (before, after) for name, before, after in figures(result, face_count=102)}
    assert list(rows) == ["PE", "E_d", "Stretch", "Gap", "Charts", "Seams", "BL", "Faces"]
    assert rows["Faces"] == ("102", "102")
    one_chart = atlas_refine.refine(*shapes.tight())
    assert figures(one_chart, face_count=64)[3] == ("Gap", "-", "-")
