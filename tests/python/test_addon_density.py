"""addon/core: texel density, without Blender."""

from dataclasses import replace

import atlas_refine
import numpy as np
import pytest
import shapes
from core.density import Density, density_lines, surface_area, too_small, uv_area
from core.options import Options, Texture
from core.request import prepare
from test_addon_request import faces, make_part, run

VALUE = Options(aspect="FREE", gap="AUTO", density="VALUE", texel_density=300.0, texture_size=1024, pe_bound=0.6)


def test_areas():
    positions, offsets, corners, uvs = shapes.join(shapes.grid(3, 2), shapes.grid(2, 2, origin=(5.0, 0.0), scale=2.0))
    assert surface_area(positions, offsets, corners) == pytest.approx(10.0)
    assert uv_area(offsets, uvs) == pytest.approx(6.0 + 16.0)
    assert uv_area(offsets, -uvs[:, ::-1]) == pytest.approx(22.0)  # turned over
    uvs[0] = np.nan
    assert uv_area(offsets, uvs) == pytest.approx(21.0)


def test_pixels_per_metre():
    """A unit square of UVs for each unit square of the surface, 1 unit long in the object."""
    part = make_part(shapes.tight())
    request = prepare(atlas_refine, [part], Options())
    assert request.density(Options(texture_size=64), None, 1.0).before == pytest.approx(64.0)
    assert request.density(Options(), Texture("Skin", 64, 16), 1.0).before == pytest.approx(32.0)
    assert request.density(Options(texture_size=64), None, 0.5).before == pytest.approx(128.0)  # a unit is half a metre
    part.scale = 4.0
    assert request.density(Options(texture_size=64), None, 1.0).before == pytest.approx(16.0)


@pytest.mark.parametrize("scales", [(1.0,), (5.0,), (1.0, 3.0)])
def test_a_free_box_gets_the_density_that_is_asked(scales):
    parts = [make_part(scale=scale) for scale in scales]
    options = replace(VALUE, stacks="SEPARATE")
    request = prepare(atlas_refine, parts, options, metres=0.01)
    density = request.density(options, None, 0.01, run(request))
    assert density.is_free
    assert density.after == pytest.approx(300.0, rel=1e-5)
    assert density.before != pytest.approx(300.0, rel=0.1)


def test_a_texture_is_filled_and_locked_charts_make_the_box_one():
    part = make_part()
    assert "uv_density" not in prepare(atlas_refine, [part], replace(VALUE, aspect="TEXTURE")).arguments
    part.pinned = faces(part, 0, 48)
    assert "uv_density" not in prepare(atlas_refine, [part], VALUE).arguments


def test_what_is_told():
    measured = Density((1024, 512), 100.0)
    assert list(density_lines(measured)) == ["Density 100 px/m", "of a texture of 1024 x 512"]
    assert list(density_lines(replace(measured, wanted=250.0)))[2] == "250 px/m need 2560 px: take 4096"
    assert too_small(replace(measured, wanted=250.0)) == "250 px/m need a texture of 2560 px and this one has 1024: take 4096"
    assert too_small(measured) == ""
    assert list(density_lines(replace(measured, wanted=80.0)))[2] == "80 px/m need 820 px: it has them"
    assert list(density_lines(replace(measured, wanted=40.0)))[2] == "40 px/m need 410 px: 512 would do"
    assert too_small(replace(measured, wanted=40.0)) == ""
    assert replace(measured, wanted=1e-3).size_to_take == 16
    refined = Density((1024, 1024), 100.0, after=128.0, wanted=100.0)
    assert (refined.size_to_take, too_small(refined)) == (0, "")
    assert list(density_lines(refined))[::2] == ["Density 100 -> 128 px/m", "100 px/m need 800 px: it has them"]
    free = Density((1024, 1024), 100.0, after=300.0, wanted=300.0, is_free=True, box_px=(1500.0, 900.0))
    assert list(density_lines(free))[2] == "300 px/m need 1500 px: take 2048"
