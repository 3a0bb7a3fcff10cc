"""The signal approximation error against what it must be on flat sheets."""

import check_atlas
import numpy as np
import pytest
import signal_error

SHEET = 20


def sheet(tmp_path, place_uv):
    """A flat unit square of quads whose UVs are place_uv of its points."""
    n = SHEET + 1
    points = [(i / SHEET, j / SHEET) for j in range(n) for i in range(n)]
    lines = [f"v {x} {y} 0" for x, y in points]
    lines += ["vt {} {}".format(*place_uv(x, y)) for x, y in points]
    quads = [(j * n + i + 1, j * n + i + 2, (j + 1) * n + i + 2, (j + 1) * n + i + 1) for j in range(SHEET) for i in range(SHEET)]
    lines += ["f " + " ".join(f"{k}/{k}" for k in quad) for quad in quads]
    (tmp_path / "sheet.obj").write_text("\n".join(lines) + "\n")
    return check_atlas.read_obj(tmp_path / "sheet.obj")


# A step of the signal between two texel centres costs 1/6 texel per unit of its length, in the mean over where it lies; there
# are two families of lines, TEXELS / 100 apart.
TEXELS = 2048
STEP = 2 / (TEXELS / 100) / 6


def error_of(obj, texels=TEXELS):
    return signal_error.signal_error(obj, texels, samples=500_000)


def test_flat_sheet_costs_what_steps_cost(tmp_path):
    assert error_of(sheet(tmp_path, lambda x, y: (x, y))) == pytest.approx(STEP, rel=0.06)


def test_half_the_texels_along_a_side_cost_twice(tmp_path):
    obj = sheet(tmp_path, lambda x, y: (x, y))
    assert error_of(obj, TEXELS // 2) / error_of(obj) == pytest.approx(2, rel=0.08)


def test_place_and_unit_of_the_uvs_do_not_matter(tmp_path):
    other = error_of(sheet(tmp_path, lambda x, y: (7 * x - 3, 7 * y + 5)))
    assert other == pytest.approx(error_of(sheet(tmp_path, lambda x, y: (x, y))), rel=0.01)


def test_sheet_on_itself_is_seen(tmp_path):
    """Folded in the middle: black comes to lie on white, so one half of the surface reads the wrong colour."""
    assert error_of(sheet(tmp_path, lambda x, y: (abs(x - 0.5), y))) == pytest.approx(0.5, rel=0.05)


def test_every_covered_texel_is_found_once_by_its_centre(tmp_path):
    turn = np.array([[0.8, -0.6], [0.6, 0.8]])
    obj = sheet(tmp_path, lambda x, y: turn @ (x, y))
    surface = signal_error.Surface(obj, 256)
    covered = signal_error.texture_of(surface, 256)[1]
    assert covered.sum() == pytest.approx((256 / 1.4) ** 2, rel=0.01)
    centres = (np.argwhere(covered)[:, ::-1] + 0.5) * (1.4 / 256) - (0.6, 0)
    inside = centres @ turn
    assert inside.min() > -1e-9
    assert inside.max() < 1 + 1e-9


def test_dilation_reaches_two_texels(tmp_path):
    texture, covered = np.zeros((9, 9), np.float32), np.zeros((9, 9), bool)
    texture[4, 4], covered[4, 4] = 0.5, True
    grown = signal_error.dilated(texture, covered)
    assert (grown[2:7, 2:7] == 0.5).all()
    assert grown.sum() == pytest.approx(25 * 0.5)
