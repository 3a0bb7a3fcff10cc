# SPDX-License-Identifier: GPL-3.0-or-later
"""Texel density: pixels of the texture for a metre of the surface, of a whole atlas."""

import math
from dataclasses import dataclass

import numpy as np

from .cuts import following_corners


@dataclass(frozen=True)
class Density:
    """What the panel tells; in pixels per metre."""

    size: tuple  # (width, height) of the texture in pixels
    before: float
    after: float | None = None  # None: nothing was refined
    wanted: float = 0.0  # 0: none
    is_free: bool = False  # the UVs have the wanted density, whatever part of the texture, or beyond it, that takes
    box_px: tuple = (0.0, 0.0)  # that they take

    @property
    def now(self):
        return self.before if self.after is None else self.after


def surface_area(positions, face_offsets, corner_vertices):
    """Of all faces, as flat as they can be."""
    corners = positions.astype(np.float64)[corner_vertices]
    return float(np.linalg.norm(_twice_areas(corners, face_offsets), axis=1).sum()) / 2


def uv_area(face_offsets, corner_uvs):
    """Of all faces whose UVs are numbers, also of those turned over."""
    flat = np.column_stack([corner_uvs.astype(np.float64), np.zeros(len(corner_uvs))])
    return float(np.nansum(np.abs(_twice_areas(flat, face_offsets)[:, 2]))) / 2


def pixels_per_metre(area_in_uv, size, area, metres):
    """`area` in units of `metres` metres, squared; 0 where there is no area."""
    return math.sqrt(area_in_uv * size[0] * size[1] / area) / metres if area > 0 else 0.0


def density_lines(density):
    """What the panel says, in lines that a narrow sidebar has room for."""
    change = "" if density.after is None else f" -> {_short(density.after)}"
    yield f"Density {_short(density.before)}{change} px/m"
    yield f"of a texture of {density.size[0]} x {density.size[1]}"
    if density.wanted == 0 or density.now == 0:
        return
    if density.is_free and density.after is not None:
        longest = max(density.box_px)
    else:
        longest = max(density.size) * density.wanted / density.now
    longest = math.ceil(longest - 1e-3)
    enough = "it has them" if longest <= max(density.size) else f"take {_power_of_two(longest)}"
    yield f"{_short(density.wanted)} px/m need {longest} px: {enough}"


def _short(value):
    return f"{value:.0f}" if value >= 100 else f"{value:.3g}"


def _power_of_two(pixels):
    return 2 ** math.ceil(math.log2(pixels))


def _twice_areas(corners, face_offsets):
    """(F, 3) vectors: the normal of each face, as long as twice its area."""
    sizes = np.diff(face_offsets)
    first = np.repeat(face_offsets[:-1], sizes)
    following = following_corners(face_offsets)
    return np.add.reduceat(np.cross(corners - corners[first], corners[following] - corners[first]), face_offsets[:-1])
