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


def doubled_area(points):
    exact = [(Fraction(float(x)), Fraction(float(y))) for x, y in points]
    return sum(a[0] * b[1] - a[1] * b[0] for a, b in zip(exact, exact[1:] + exact[:1], strict=True))


def keyhole(points):
    """(loops, bridges) of a polygon: what lies between edges that it walks to and fro, and those edges."""
    loops, whole, bridges = [[tuple(map(float, p)) for p in points]], [], []
    while loops:
        loop = loops.pop()
        edges = list(zip(loop, loop[1:] + loop[:1], strict=True))
        there = {edge: k for k, edge in enumerate(edges)}
        ways = [(k, there[b, a]) for k, (a, b) in enumerate(edges) if a != b and there.get((b, a), -1) > k]
        if not ways:
            whole.append(loop)
            continue
        one, other = ways[0]
        bridges.append(edges[one])
        loops += [loop[one + 1 : other], loop[other + 1 :] + loop[:one]]
    return whole, bridges


def lies_inside(point, loop):
    """Whether the point, on no edge of the loop, lies in it."""
    inside = False
    for a, b in zip(loop, loop[1:] + loop[:1], strict=True):
        if (a[1] > point[1]) != (b[1] > point[1]):
            inside ^= (exact_orientation(a, b, point) > 0) == (b[1] > a[1])
    return inside


def bridges_fit(loops, bridges):
    """Bridges touch nothing but loops and other bridges in their ends."""
    edges = [edge for loop in loops for edge in zip(loop, loop[1:] + loop[:1], strict=True)]
    for k, (a, b) in enumerate(bridges):
        for c, d in (*edges, *bridges[:k]):
            if not {a, b} & {c, d} and exactly_touch(a, b, c, d):
                return False
    return True


def keyhole_is_simple(loops, bridges):
    """One loop runs around the inside, all others clockwise around holes in it."""
    outer = [loop for loop in loops if len(loop) > 2 and doubled_area(loop) > 0]
    holes = [loop for loop in loops if len(loop) > 2 and doubled_area(loop) < 0]
    if len(outer) != 1 or len(holes) + 1 != len(loops):
        return False
    if not all(polygon_is_simple(loop) for loop in (*outer, *(hole[::-1] for hole in holes))):
        return False
    if not all(lies_inside(hole[0], outer[0]) for hole in holes):
        return False
    rings = [list(zip(loop, loop[1:] + loop[:1], strict=True)) for loop in loops]
    if any(exactly_touch(*e, *f) for k, ring in enumerate(rings) for other in rings[:k] for e in ring for f in other):
        return False
    nested = any(lies_inside(a[0], b) for a in holes for b in holes if a is not b)
    return not nested and bridges_fit(loops, bridges)


def polygon_is_simple(points):
    """Whether a polygon runs around its inside once, counter-clockwise, without touching itself but along the bridges of holes."""
    n = len(points)
    if doubled_area(points) <= 0:
        return False
    loops, bridges = keyhole(points)
    if bridges:
        return keyhole_is_simple(loops, bridges)
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
