"""Generated atlases for the tests of the Python API, as the four array arguments of refine()."""

import numpy as np


def grid(columns, rows, origin=(0.0, 0.0), scale=1.0, bend=0.0):
    """One chart: a grid of unit quads on the surface; `bend` turns it into an arc (in UV only) of that many radians;
    columns / bend must be larger than rows."""
    x, y = np.meshgrid(np.arange(columns + 1.0), np.arange(rows + 1.0))
    positions = np.column_stack([x.ravel(), y.ravel(), np.zeros(x.size)])
    uvs = positions[:, :2].copy()
    if bend:
        radius, angle_rad = columns / bend, (x.ravel() / columns - 0.5) * bend
        uvs = np.column_stack([(radius - y.ravel()) * np.sin(angle_rad), radius - (radius - y.ravel()) * np.cos(angle_rad)])
    corner = (np.arange(rows)[:, None] * (columns + 1) + np.arange(columns)[None, :]).ravel()
    faces = np.column_stack([corner, corner + 1, corner + columns + 2, corner + columns + 1])
    return positions, faces, uvs * scale + origin


def join(*charts):
    """Charts side by side on the surface, each with vertices of its own."""
    positions, faces, uvs = [], [], []
    vertex_count, shift = 0, 0.0
    for chart_positions, chart_faces, chart_uvs in charts:
        positions.append(chart_positions + [shift, 0.0, 0.0])
        faces.append(chart_faces + vertex_count)
        uvs.append(chart_uvs[chart_faces.ravel()])
        vertex_count += len(chart_positions)
        shift = positions[-1][:, 0].max() + 5.0
    corner_vertices = np.concatenate([f.ravel() for f in faces])
    face_offsets = np.arange(0, len(corner_vertices) + 1, 4)
    return np.concatenate(positions), face_offsets, corner_vertices, np.concatenate(uvs)


def loose():
    """Three charts, an arc among them, scattered so that the packing efficiency is low (about 0.2)."""
    return join(grid(12, 4, bend=2.5), grid(6, 6, origin=(20.0, 3.0)), grid(9, 2, origin=(2.0, 14.0)))


def tight():
    """One square chart that fills its box."""
    return join(grid(8, 8))


def arcs(count, columns):
    """Long strips in UV arcs of different bend; much work for the engine at a high bound."""
    rows = columns // 10
    return join(*(grid(columns, rows, origin=(0.0, 2.0 * columns * i), bend=2.0 + 0.3 * i) for i in range(count)))


def slow():
    """Several seconds of work at a bound of 0.95."""
    return arcs(6, 120)
