"""Signs and contacts in the plane: in floating point where that is safe, in rational arithmetic where it is not."""

from fractions import Fraction

import numpy as np


def exact_orientation(a, b, c):
    (ax, ay), (bx, by), (cx, cy) = ((Fraction(float(x)), Fraction(float(y))) for x, y in (a, b, c))
    det = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
    return (det > 0) - (det < 0)


def orientation(a, b, c):
    """Sign of the turn a, b, c for arrays of points: in floating point, rational where that might err."""
    left = (b[:, 0] - a[:, 0]) * (c[:, 1] - a[:, 1])
    right = (b[:, 1] - a[:, 1]) * (c[:, 0] - a[:, 0])
    det = left - right
    sign = np.sign(det).astype(int)
    for i in np.flatnonzero(np.abs(det) <= 1e-14 * (np.abs(left) + np.abs(right))):
        sign[i] = exact_orientation(a[i], b[i], c[i])
    return sign


def exactly_touch(p, q, r, s):
    """Whether the closed segments pq and rs have a point in common."""
    o = [exact_orientation(p, q, r), exact_orientation(p, q, s), exact_orientation(r, s, p), exact_orientation(r, s, q)]
    if o[0] * o[1] < 0 and o[2] * o[3] < 0:
        return True

    def in_box(a, b, c):
        return min(a[0], b[0]) <= c[0] <= max(a[0], b[0]) and min(a[1], b[1]) <= c[1] <= max(a[1], b[1])

    cases = ((o[0], p, q, r), (o[1], p, q, s), (o[2], r, s, p), (o[3], r, s, q))
    return any(sign == 0 and in_box(a, b, c) for sign, a, b, c in cases)


def polygon_is_simple(points):
    """Whether a polygon runs around its inside once, counter-clockwise, without touching itself."""
    n = len(points)
    exact = [(Fraction(float(x)), Fraction(float(y))) for x, y in points]
    if sum(a[0] * b[1] - a[1] * b[0] for a, b in zip(exact, exact[1:] + exact[:1], strict=True)) <= 0:
        return False
    for i in range(n):
        a, b, c = points[i], points[(i + 1) % n], points[(i + 2) % n]
        if folds_back(a, b, c):
            return False
        for j in range(i + 2, n):
            if (j + 1) % n != i and exactly_touch(a, b, points[j], points[(j + 1) % n]):
                return False
    return True


def folds_back(a, b, c):
    return exact_orientation(a, b, c) == 0 and float(np.dot(a - b, c - b)) >= 0
