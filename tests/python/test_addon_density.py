"""addon/core: texel density, without Blender."""

from dataclasses import replace

import atlas_refine
import numpy as np
import pytest
import shapes
from core.canvas import Canvas
from core.density import Density, density_lines, surface_areas, too_small, uv_areas
from core.options import Options, Texture
from core.request import prepare
from test_addon_request import faces, make_part, run

VALUE = Options(aspect="FREE", gap="AUTO", density="VALUE", texel_density=300.0, texture_size=1024, pe_bound=0.6)


def test_areas():
    positions, offsets, corners, uvs = shapes.join(shapes.grid(3, 2), shapes.grid(2, 2, origin=(5.0, 0.0), scale=2.0))
    assert surface_areas(positions, offsets, corners) == pytest.approx([1.0] * 10)
    assert uv_areas(offsets, uvs) == pytest.approx([1.0] * 6 + [4.0] * 4)
    assert uv_areas(offsets, -uvs[:, ::-1]) == pytest.approx([1.0] * 6 + [4.0] * 4)  # turned over
    for no_number in (np.nan, np.inf):
        uvs[:2] = no_number
        assert uv_areas(offsets, uvs).sum() == pytest.approx(21.0)
        positions[0] = no_number
        assert surface_areas(positions, offsets, corners).sum() == pytest.approx(9.0)


def test_pixels_per_metre():
    """A unit square of UVs for each unit square of the surface, 1 unit long in the object."""
    part = make_part(shapes.tight())
    small = Options(texture_size=64)
    request = prepare(atlas_refine, [part], Options())
    assert density_of(request, small).before == pytest.approx(64.0)
    assert density_of(request, small, 0.5).before == pytest.approx(128.0)  # a unit is half a metre
    skin = prepare(atlas_refine, [part], Options(), [Canvas(Texture("Skin", 64, 16))])
    assert density_of(skin, Options()).before == pytest.approx(32.0)
    part.scale = 4.0
    assert density_of(request, small).before == pytest.approx(16.0)


def density_of(request, options, metres=1.0, result=None):
    (density,) = request.densities(options, metres, result)
    return density


@pytest.mark.parametrize("scales", [(1.0,), (5.0,), (1.0, 3.0)])
def test_a_free_box_gets_the_density_that_is_asked(scales):
    parts = [make_part(scale=scale) for scale in scales]
    options = replace(VALUE, stacks="SEPARATE")
    request = prepare(atlas_refine, parts, options, metres=0.01)
    density = density_of(request, options, 0.01, run(request))
    assert density.is_free
    assert density.after == pytest.approx(300.0, rel=1e-5)
    assert density.before != pytest.approx(300.0, rel=0.1)


def test_a_texture_has_the_density_that_is_asked_or_its_size_is_told():
    options = Options(density="VALUE", texel_density=30.0, texture_size=1024)
    request = prepare(atlas_refine, [make_part()], options)
    result = run(request)
    density = density_of(request, options, result=result)
    assert density.after == pytest.approx(30.0, rel=1e-5)
    assert (density.is_free, density.is_too_small) == (False, False)
    assert density.needed_px / 1024 == pytest.approx(np.sqrt(result.after.pe_fixed_aspect / 0.8), rel=2e-3)
    assert density.size_to_take == 512
    options = replace(options, texel_density=1000.0)
    request = prepare(atlas_refine, [make_part()], options)
    density = density_of(request, options, result=run(request))
    assert density.after < 1000.0
    assert density.is_too_small
    assert density.needed_px / 1024 == pytest.approx(1000.0 / density.after, rel=2e-3)


def test_each_material_has_the_density_in_its_own_texture():
    part = make_part()
    part.materials[48:] = 1
    options = Options(density="VALUE", texel_density=20.0, atlases="MATERIAL")
    canvases = [Canvas(Texture("Skin", 512, 256), name="Skin"), Canvas(Texture("Cloth", 256, 1024), name="Cloth")]
    request = prepare(atlas_refine, [part], options, canvases)
    assert request.arguments["group_densities"] == [20.0 / 256, 20.0 / 1024]
    for density, size in zip(request.densities(options, 1.0, run(request)), ((512, 256), (256, 1024)), strict=True):
        assert density.size == size
        assert density.after == pytest.approx(20.0, rel=1e-5)


def test_locked_charts_have_the_density_that_they_have():
    part = make_part()
    part.pinned = faces(part, 0, 48)
    assert "uv_density" not in prepare(atlas_refine, [part], VALUE).arguments
    assert "uv_density" not in prepare(atlas_refine, [part], replace(VALUE, aspect="TEXTURE")).arguments


def test_locked_charts_end_the_density_of_their_own_box_only():
    part = make_part()
    part.materials[84:] = 1
    part.pinned = faces(part, 0, 48)
    canvases = [Canvas(Texture("Skin", 512, 512), name="Skin"), Canvas(Texture("Cloth", 256, 1024), name="Cloth")]
    options = Options(density="VALUE", texel_density=20.0, atlases="MATERIAL")
    request = prepare(atlas_refine, [part], options, canvases)
    held, free = request.arguments["group_densities"]
    assert (held, free) == (0.0, 20.0 / 1024)
    assert request.arguments["uv_density"] == free
    cloth = list(request.densities(options, 1.0, run(request)))[1]
    assert cloth.after == pytest.approx(20.0, rel=1e-5)


def test_what_is_told():
    measured = Density((1024, 512), 100.0)
    assert list(density_lines(measured)) == ["Density 100 px/m", "of a texture of 1024 x 512"]
    assert list(density_lines(replace(measured, wanted=250.0)))[2] == "250 px/m need 2560 px: take 4096"
    assert too_small(replace(measured, wanted=250.0)) == "250 px/m need a texture of 2560 px and this one has 1024: take 4096"
    assert list(density_lines(replace(measured, wanted=80.0)))[2] == "80 px/m need 820 px: it has them"
    assert list(density_lines(replace(measured, wanted=40.0)))[2] == "40 px/m need 410 px: 512 would do"
    assert replace(measured, wanted=1e-3).size_to_take == 16
    refined = Density((1024, 1024), 90.0, after=100.0, wanted=100.0, spare=1.2)
    assert (refined.size_to_take, refined.is_too_small) == (0, False)
    assert list(density_lines(refined))[::2] == ["Density 90 -> 100 px/m", "100 px/m need 935 px: it has them"]
    assert list(density_lines(refined, "Skin"))[:2] == ["Skin: 90 -> 100 px/m", "of its texture of 1024 x 1024"]
    free = Density((1024, 1024), 100.0, after=300.0, wanted=300.0, is_free=True, box_px=(1500.0, 900.0))
    assert list(density_lines(free))[2] == "300 px/m need 1500 px: take 2048"
