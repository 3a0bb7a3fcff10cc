# SPDX-License-Identifier: GPL-3.0-or-later
"""Borders of charts in the UV map, and those that come nearer to another chart, or to the texture's border, than a margin."""

import numpy as np

from .cuts import following_corners

#: Segments of one cell that are compared with each other: where borders are more crowded than that, some are not looked at.
_MOST_IN_A_CELL = 400
_LEAST_CELLS = 64


def border_corners(atlas):
    """Corners at which an edge begins that belongs to no other face with the same UVs."""
    following = following_corners(atlas.face_offsets)
    here, there = atlas.corner_vertices, atlas.corner_vertices[following]
    turned = here > there
    first = np.where(turned, following, np.arange(len(here)))
    second = np.where(turned, np.arange(len(here)), following)
    # UVs that are equal to an artist: Blender joins what differs by less.
    places = np.round(np.nan_to_num(atlas.corner_uvs) * 65536.0).astype(np.int64)
    rows = np.column_stack([np.minimum(here, there), np.maximum(here, there), places[first], places[second]])
    _, group, count = np.unique(_hashes(rows), return_inverse=True, return_counts=True)
    return np.flatnonzero(count[group] == 1)


def edge_corners(atlas, edges):
    """Corners at which one of these edges, (S, 2) vertices, begins in some face."""
    following = following_corners(atlas.face_offsets)
    return np.flatnonzero(are_among(np.column_stack([atlas.corner_vertices, atlas.corner_vertices[following]]), edges))


def are_among(edges, wanted):
    """(n,) bool of (n, 2) vertices: those edges that are among (S, 2) others, whichever end comes first."""
    count = max((int(ends.max()) for ends in (edges, wanted) if len(ends)), default=0) + 1
    numbers = [ends.min(axis=1).astype(np.int64) * count + ends.max(axis=1) for ends in (edges, wanted)]
    return np.isin(*numbers)


def segments(values, face_offsets, corners):
    """(n, 2, d): the values of these corners and of those that follow them."""
    return np.stack([values[corners], values[following_corners(face_offsets)[corners]]], axis=1)


def without_stacked(charts, ends):
    """(n,) bool of (n, 2, 2) segments: those of charts whose bounding box no earlier chart has, to four digits of its size."""
    count = int(charts.max()) + 1 if len(charts) else 0
    low, high = np.full((count, 2), np.inf), np.full((count, 2), -np.inf)
    np.minimum.at(low, charts, ends.min(axis=1))
    np.maximum.at(high, charts, ends.max(axis=1))
    there = np.flatnonzero(np.isfinite(low[:, 0]))
    boxes = np.column_stack([low, high])[there]
    size = max(float(np.ptp(boxes)) if len(boxes) else 0.0, 1e-12)
    _, first = np.unique(np.round(boxes / size * 1e4), axis=0, return_index=True)
    kept = np.zeros(count, dtype=bool)
    kept[there[first]] = True
    return kept[charts]


def near_others(ends, charts, margin):
    """(n,) bool of (n, 2, 2) segments: those nearer than the margin to a segment of another chart."""
    near = np.zeros(len(ends), dtype=bool)
    owners, cells = _in_cells(ends, margin)
    order = np.argsort(cells, kind="stable")
    owners, cells = owners[order], cells[order]
    for k in range(1, min(_MOST_IN_A_CELL, len(cells))):
        together = np.flatnonzero(cells[k:] == cells[:-k])
        if not len(together):
            break
        a, b = owners[together], owners[together + k]
        apart = charts[a] != charts[b]
        a, b = a[apart], b[apart]
        found = distances(ends[a], ends[b]) < margin
        near[a[found]] = near[b[found]] = True
    return near


def near_texture_border(ends, size, margin):
    """(n,) bool of segments in pixels: those nearer than the margin to the border of the tile that they lie in."""
    size = np.asarray(size, dtype=np.float64)
    corner = np.floor(ends.mean(axis=1) / size)[:, None] * size
    within = ends - corner
    return np.any((within < margin) | (within > size - margin), axis=(1, 2))


def distances(first, second):
    """Of pairs of segments, (n, 2, 2) each; 0 where they cross."""
    least = np.minimum.reduce(
        [_to_segment(first[:, k], second) for k in (0, 1)] + [_to_segment(second[:, k], first) for k in (0, 1)]
    )
    return np.where(_cross(first, second), 0.0, least)


def _hashes(rows):
    """A number for each row, equal where the rows are: sorting numbers takes a tenth of the time of sorting rows."""
    out = np.zeros(len(rows), dtype=np.uint64)
    for column in rows.astype(np.uint64).T:
        out = (out ^ column) * np.uint64(0x9E3779B97F4A7C15)
        out ^= out >> np.uint64(29)
    return out


def _in_cells(ends, margin):
    """(owner, cell) of each segment, grown by half the margin, and each cell of a grid that its box touches."""
    low, high = ends.min(axis=1) - 0.5 * margin, ends.max(axis=1) + 0.5 * margin
    if not len(ends):
        return np.zeros(0, dtype=np.int64), np.zeros(0, dtype=np.int64)
    extent = float(np.max(high.max(axis=0) - low.min(axis=0)))
    cell = min(max(2 * margin, float(np.mean(np.ptp(ends, axis=1))), extent / 4096), extent / _LEAST_CELLS)
    origin = low.min(axis=0)
    from_, to = ((low - origin) // cell).astype(np.int64), ((high - origin) // cell).astype(np.int64)
    across = to - from_ + 1
    each = across[:, 0] * across[:, 1]
    owners = np.repeat(np.arange(len(ends)), each)
    place = np.arange(each.sum()) - np.repeat(np.cumsum(each) - each, each)
    x = from_[owners, 0] + place % across[owners, 0]
    y = from_[owners, 1] + place // across[owners, 0]
    return owners, x * (int(to[:, 1].max()) + 1) + y


def _to_segment(points, ends):
    direction = ends[:, 1] - ends[:, 0]
    square = np.maximum(np.sum(direction**2, axis=1), 1e-300)
    part = np.clip(np.sum((points - ends[:, 0]) * direction, axis=1) / square, 0, 1)
    return np.linalg.norm(ends[:, 0] + part[:, None] * direction - points, axis=1)


def _cross(first, second):
    def side(ends, points):
        d, p = ends[:, 1] - ends[:, 0], points - ends[:, 0]
        return d[:, 0] * p[:, 1] - d[:, 1] * p[:, 0]

    apart = side(first, second[:, 0]) * side(first, second[:, 1]) < 0
    return apart & (side(second, first[:, 0]) * side(second, first[:, 1]) < 0)
