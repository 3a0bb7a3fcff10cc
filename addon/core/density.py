# SPDX-License-Identifier: GPL-3.0-or-later
"""Texel density: pixels of the texture for a metre of the surface."""

import math
from dataclasses import dataclass

import numpy as np

#: Of a texture, in pixels.
LEAST_SIZE = 16
#: So many times as dense as another object one is worth a note.
UNEQUAL_PARTS = 4
#: Of the texture: what unwrapping for all of it leaves free at most, and how far it may reach beyond it.
_FILLS, _BESIDE = 0.75, 0.01


@dataclass(frozen=True)
class Density:
    """What the panel tells of one texture, or tile; in pixels per metre."""

    size: tuple  # (width, height) of the texture in pixels
    before: float
    after: float | None = None  # None: nothing was refined
    wanted: float = 0.0  # 0: none
    is_free: bool = False  # the UVs have the wanted density, whatever part of the texture, or beyond it, that takes
    box_px: tuple = (0.0, 0.0)  # that they take
    spare: float = 1.0  # what they may cover of the texture, by what they do, where that is less
    of_image: bool = False  # the size is an image's

    @property
    def now(self):
        return self.before if self.after is None else self.after

    @property
    def needed_px(self):
        """Of the longer side of a texture in which the charts have the wanted density; 0 where none is asked for."""
        if self.wanted == 0 or self.now == 0:
            return 0
        in_place = self.is_free and self.after is not None
        needed = max(self.box_px) if in_place else max(self.size) * self.wanted / (self.now * math.sqrt(self.spare))
        return math.ceil(needed * (1 - 1e-4))  # UVs are rounded

    @property
    def is_too_small(self):
        return self.needed_px > max(self.size)

    @property
    def size_to_take(self):
        """The power of two that holds that where the texture does not, or where a smaller one does too; else 0."""
        if self.needed_px == 0:
            return 0
        holds = max(LEAST_SIZE, 2 ** math.ceil(math.log2(self.needed_px)))
        return holds if self.is_too_small or holds < max(self.size) else 0


def surface_areas(positions, face_offsets, corner_vertices):
    """(F,) of the faces, as flat as they can be; 0 where positions are no numbers."""
    x, y, z = _twice_areas(positions, face_offsets, corner_vertices)
    return np.sqrt(x**2 + y**2 + z**2) / 2


def notes_on_unequal(parts):
    """Of objects each of which was unwrapped for a texture of its own, where they are to share one and keep their densities."""
    found = [density for density in map(_density_of_unwrapped, parts) if density > 0]
    if len(found) < max(2, len(parts)) or max(found) <= UNEQUAL_PARTS * min(found):
        return
    least, most = (parts[found.index(pick(found))].name for pick in (min, max))
    yield f"{most} has {max(found) / min(found):.3g} times the texel density of {least}, and keeps it: Density: Equal evens them out"


def _density_of_unwrapped(part):
    """UV units for a unit of the world; 0 where its UVs do not fill the texture from side to side, or reach beyond it."""
    atlas, uvs = part.atlas, part.atlas.corner_uvs[np.isfinite(part.atlas.corner_uvs).all(axis=1)]
    if len(uvs) == 0 or uvs.min() < -_BESIDE or uvs.max() > 1 + _BESIDE or np.ptp(uvs, axis=0).max() < _FILLS:
        return 0.0
    area = surface_areas(atlas.positions, atlas.face_offsets, atlas.corner_vertices)[part.taken].sum() * part.scale**2
    return math.sqrt(uv_areas(atlas.face_offsets, atlas.corner_uvs)[part.taken].sum() / area) if area > 0 else 0.0


def uv_areas(face_offsets, corner_uvs):
    """(F,) of the faces, also of those turned over; 0 where UVs are no numbers."""
    return np.abs(_twice_areas(corner_uvs, face_offsets)[0]) / 2


def pixels_per_metre(area_in_uv, size, area, metres):
    """`area` in units of `metres` metres, squared; 0 where there is no area."""
    return math.sqrt(area_in_uv * size[0] * size[1] / area) / metres if area > 0 else 0.0


def density_lines(density, name=""):
    """What the panel says, in lines that a narrow sidebar has room for; `name`: of the texture, where there are several."""
    change = "" if density.after is None else f" -> {_short(density.after)}"
    yield f"{name + ':' if name else 'Density'} {_short(density.before)}{change} px/m"
    yield f"of {'its' if name else 'a'} texture of {density.size[0]} x {density.size[1]}"
    if density.needed_px > 0:
        enough = f"{density.size_to_take} would do" if density.size_to_take else "it has them"
        if density.is_too_small:
            enough = f"take {density.size_to_take}"
        yield f"{_short(density.wanted)} px/m need {density.needed_px} px: {enough}"


def too_small(density):
    """What a script is told where the texture does not hold the wanted density."""
    needed = f"{_short(density.wanted)} px/m need a texture of {density.needed_px} px"
    return f"{needed} and this one has {max(density.size)}: take {density.size_to_take}"


def _short(value):
    return f"{value:.0f}" if value >= 100 else f"{value:.3g}"


@np.errstate(invalid="ignore")
def _twice_areas(points, face_offsets, corner_points=None):
    """Of (n, 2) or (n, 3) points: (F,) of the faces in the plane, or in each of three, negative where they are turned over, 0 where
    they have points that are no numbers. As fans of triangles, a coordinate at a time: NumPy's cross() and sums over each face take
    several times as long."""
    in_fan = np.maximum(np.diff(face_offsets) - 2, 0)
    faces = np.repeat(np.arange(len(in_fan)), in_fan)
    third = np.arange(len(faces)) + np.repeat(face_offsets[:-1] + 2 - (np.cumsum(in_fan) - in_fan), in_fan)
    corners = (face_offsets[:-1][faces], third - 1, third)
    apex, second, third = corners if corner_points is None else (corner_points[of] for of in corners)
    columns = [np.ascontiguousarray(column, dtype=np.float64) for column in points.T]
    rays = [(column[second] - column[apex], column[third] - column[apex]) for column in columns]
    pairs = list(zip(rays, rays[1:] + rays[:1], strict=True))[: 3 if len(rays) == 3 else 1]
    sums = [np.bincount(faces, weights=a[0] * b[1] - a[1] * b[0], minlength=len(in_fan)) for a, b in pairs]
    return [np.nan_to_num(of_faces, posinf=0, neginf=0) for of_faces in sums]
