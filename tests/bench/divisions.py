"""Which divisions of a face into triangles are positive in the UV plane: readers fan, clip ears, or take either diagonal of a quad."""

import numpy as np
from exact import orientation, polygon_is_simple
from triangles import SLIVER, ear_triangles, fan_triangles

NAMES = ("fan", "ears", "diagonals")


def _all_positive(obj, sense, triangles, face, thin):
    """Of each face: all of its triangles are positive and, where `thin` is given, higher than that part of their longest side."""
    a, b, c = (obj.corner_uv[triangles[:, k]] for k in range(3))
    good = orientation(a, b, c) * sense[face] > 0
    if thin:
        area = np.abs((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0])
        longest = np.maximum.reduce([np.linalg.norm(e, axis=1) for e in (b - a, c - a, c - b)])
        good &= area > thin * longest**2
    return np.bincount(face, ~good, minlength=len(obj.offsets) - 1) == 0


def positive_divisions(obj, sense, thin=0.0):
    """By name one flag per face. Of polygons of more than four corners the ears stand for all diagonals: they are convex."""
    fan = _all_positive(obj, sense, *fan_triangles(obj.offsets), thin)
    convex = fan & _all_positive(obj, sense, *ear_triangles(obj.offsets), thin)
    ears = fan.copy()
    for f in np.flatnonzero(~fan & (np.diff(obj.offsets) > 3)):
        ears[f] = polygon_is_simple(obj.corner_uv[obj.offsets[f] : obj.offsets[f + 1]][:: sense[f]])
    return dict(zip(NAMES, (fan, ears, convex), strict=True))


def kept_whole(before, after, sources):
    """Faces of the result that have the corners of the face that they come from."""
    sides = np.diff(after.offsets)
    same = sides == np.diff(before.offsets)[sources]
    face = np.repeat(np.arange(len(sides)), sides)
    place = np.arange(len(face)) - after.offsets[face]
    there = np.where(same[face], before.offsets[sources[face]] + place, 0)
    differ = before.corner_vertex[there] != after.corner_vertex
    return same & (np.bincount(face, differ, minlength=len(sides)) == 0)


def lost_divisions(before, after, sources):
    """By name the faces of the result that are not positive though their face of the input, an (obj, sense), was or they are new."""
    had, has = positive_divisions(*before, SLIVER), positive_divisions(*after)
    new = ~kept_whole(before[0], after[0], sources)
    return {name: np.flatnonzero(~has[name] & (new | had[name][sources])) for name in NAMES}, has
