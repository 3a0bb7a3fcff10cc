"""Polygons as triangles, and the distortion of those."""

import itertools
import math

import numpy as np

SLIVER = 1e-7  # triangles in space lower than this part of their longest edge have no shape of their own
NO_TRIANGLE = 1e30  # energy of slivers and of what is not positive in the UV plane
SIDES_TRIED = 100
CLEAR = 0.05  # of the share that an ear has in a square: quads with smaller ones are nearly triangles, or concave


def fan_triangles(offsets):
    """Corners of the fan triangulation, the face of each triangle."""
    count = np.diff(offsets) - 2
    face = np.repeat(np.arange(len(count)), count)
    step = np.arange(len(face)) - np.repeat(np.cumsum(count) - count, count)
    first = offsets[face]
    return np.stack([first, first + step + 1, first + step + 2], axis=1), face


def ear_triangles(offsets):
    """The corners of every polygon with their neighbours, the face of each triangle."""
    face = np.repeat(np.arange(len(offsets) - 1), np.diff(offsets))
    corner = np.arange(len(face))
    previous, following = corner - 1, corner + 1
    previous[offsets[:-1]], following[offsets[1:] - 1] = offsets[1:] - 1, offsets[:-1]
    return np.stack([previous, corner, following], axis=1), face


def jacobians(obj, triangles):
    """Of each triangle: twice its area in space, whether it is a sliver there, |J|^2 and det J; nothing that counts for slivers."""
    p = [obj.positions[obj.corner_vertex[triangles[:, k]]] for k in range(3)]
    u = [obj.corner_uv[triangles[:, k]] for k in range(3)]
    e1, e2, d1, d2 = p[1] - p[0], p[2] - p[0], u[1] - u[0], u[2] - u[0]
    double_area = np.linalg.norm(np.cross(e1, e2), axis=1)
    longest = np.maximum.reduce([np.linalg.norm(e, axis=1) for e in (e1, e2, e2 - e1)])
    sliver = ~(double_area > SLIVER * longest**2)
    x1 = np.where(sliver, 1, np.linalg.norm(e1, axis=1))
    x2, y2 = np.einsum("ij,ij->i", e1, e2) / x1, np.where(sliver, 1, double_area / x1)
    column1 = d1 / x1[:, None]
    column2 = (d2 - column1 * x2[:, None]) / y2[:, None]
    square = np.einsum("ij,ij->i", column1, column1) + np.einsum("ij,ij->i", column2, column2)
    return double_area, sliver, square, column1[:, 0] * column2[:, 1] - column1[:, 1] * column2[:, 0]


def energies(obj, triangles, scale2):
    """Area times |J|^2 + |J^-1|^2 of each triangle, UVs scaled by the root of `scale2`."""
    double_area, sliver, square, det = jacobians(obj, triangles)
    with np.errstate(divide="ignore", over="ignore", invalid="ignore"):
        energy = double_area * (square * scale2 + square / (det**2 * scale2))
    return np.where(sliver | ~np.isfinite(energy), NO_TRIANGLE, energy)


def least_energy_of_polygon(obj, corners, scale2):
    """Rows of corners: of all triangulations the one of least energy, by dynamic programming."""
    count = len(corners)
    triples = list(itertools.combinations(range(count), 3))
    energy = dict(zip(triples, energies(obj, corners[np.array(triples)], scale2).tolist(), strict=True))
    best = {(i, i + 1): (0.0, None) for i in range(count - 1)}
    for span in range(2, count):
        for i in range(count - span):
            k = i + span
            best[i, k] = min((best[i, j][0] + best[j, k][0] + energy[i, j, k], j) for j in range(i + 1, k))
    out, open_sides = [], [(0, count - 1)]
    while open_sides:
        i, k = open_sides.pop()
        if (j := best[i, k][1]) is not None:
            out.append((corners[i], corners[j], corners[k]))
            open_sides += [(i, j), (j, k)]
    return out


def least_energy_triangles(obj):
    """Corners of triangles: what distortion a polygon has depends on where it is divided; the least is what it is taken for.

    A divided face keeps its shape with corners in the middle of its sides, where a fan would be degenerate."""
    fan, face = fan_triangles(obj.offsets)
    sides = np.diff(obj.offsets)
    known = (sides[face] == 3) | (sides[face] > SIDES_TRIED)
    double_area, sliver, _, det = jacobians(obj, fan)
    uv_area = np.abs(det * double_area)[~sliver].sum()
    scale2 = double_area[~sliver].sum() / uv_area if uv_area > 0 else 1.0
    out = [fan[known]]
    quads = np.flatnonzero(sides == 4)
    first = obj.offsets[quads][:, None]
    ways = [np.concatenate([first + one, first + other]) for one, other in (((0, 1, 2), (0, 2, 3)), ((0, 1, 3), (1, 2, 3)))]
    costs = [energies(obj, way, scale2).reshape(2, -1).sum(axis=0) for way in ways]
    second = np.tile(costs[1] < costs[0], 2)
    out.append(np.where(second[:, None], ways[1], ways[0]))
    for polygon in np.flatnonzero((sides > 4) & (sides <= SIDES_TRIED)):
        corners = np.arange(obj.offsets[polygon], obj.offsets[polygon + 1])
        out.append(np.array(least_energy_of_polygon(obj, corners, scale2)))
    return np.concatenate(out)


def clearly_convex_quads(obj):
    """Quads no ear of which is small, across their mean normal in space and in the UV plane."""
    quads = np.flatnonzero(np.diff(obj.offsets) == 4)
    p = obj.positions[obj.corner_vertex[obj.offsets[quads][:, None] + np.arange(4)]]
    u = obj.corner_uv[obj.offsets[quads][:, None] + np.arange(4)]
    before, after = np.roll(p, 1, axis=1) - p, np.roll(p, -1, axis=1) - p
    normals = np.cross(after, before)
    whole = np.cross(p[:, 2] - p[:, 0], p[:, 3] - p[:, 1])
    in_space = np.einsum("qki,qi->qk", normals, whole)
    before, after = np.roll(u, 1, axis=1) - u, np.roll(u, -1, axis=1) - u
    ears = after[..., 0] * before[..., 1] - after[..., 1] * before[..., 0]
    in_plane = ears * np.sign(ears.sum(axis=1))[:, None]
    least = CLEAR / 2 * np.stack([np.einsum("qi,qi->q", whole, whole), np.abs(ears.sum(axis=1)) / 2])
    return quads[(least > 0).all(axis=0) & (in_space.min(axis=1) >= least[0]) & (in_plane.min(axis=1) >= least[1])]


def elements(obj):
    """What E_d is summed over: corners of triangles, and the part of its area that each counts for.

    Clearly convex quads count by both of their diagonals, half each; other polygons as they cost least."""
    triangles = least_energy_triangles(obj)
    quads = np.zeros(len(obj.offsets) - 1, dtype=bool)
    quads[clearly_convex_quads(obj)] = True
    ears, face = ear_triangles(obj.offsets)
    others = triangles[~quads[np.searchsorted(obj.offsets, triangles[:, 0], side="right") - 1]]
    halves = ears[quads[face]]
    return np.concatenate([others, halves]), np.repeat([1.0, 0.5], [len(others), len(halves)])


def distortion(obj, triangles, share=None):
    """E_d, eq. (9), under the global scale that minimises it, and the 99 % and largest stretch under that scale."""
    double_area, sliver, square, det = jacobians(obj, triangles)
    if sliver.all():
        return 1.0, 1.0, 1.0  # nothing has a shape that it could lose
    double_area, square, det = double_area[~sliver], square[~sliver], np.abs(det[~sliver])
    with np.errstate(divide="ignore", over="ignore", invalid="ignore"):
        inverse_square = square / det**2
        weight = double_area * (1 if share is None else share[~sliver])
        weight = weight / weight.sum()
        forth, back = float(weight @ square), float(weight @ inverse_square)
        scale = (back / forth) ** 0.25 if forth > 0 else math.inf
        root = np.sqrt(np.maximum(square**2 - 4 * det**2, 0))
        largest = np.sqrt((square + root) / 2)
        stretch = np.maximum(largest * scale, largest / (det * scale))
    if not math.isfinite(back):
        return math.inf, math.inf, math.inf
    order = np.argsort(stretch)
    at = int(np.searchsorted(np.cumsum(weight[order]), 0.99))
    return math.sqrt(forth * back) / 2, float(stretch[order][min(at, len(order) - 1)]), float(stretch.max())
