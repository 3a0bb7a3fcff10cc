# SPDX-License-Identifier: GPL-3.0-or-later
"""Stretch of faces between surface and UV map, and the colours that show it."""

import numpy as np

#: What is drawn of a face without area in the UV map or in space.
WORST = 1e6


def all_triangles(face_offsets, of_larger_faces):
    """(T, 3) corners: faces of three, then how larger ones are divided; and the face of each."""
    threes = face_offsets[:-1][np.diff(face_offsets) == 3]
    corners = np.concatenate([threes[:, None] + np.arange(3), of_larger_faces.reshape(-1, 3)]).astype(np.int64)
    return corners, np.searchsorted(face_offsets, corners[:, 0], side="right") - 1


def squares_and_determinants(positions, uvs):
    """Of the linear maps from (T, 3, 3) triangles in space to (T, 3, 2) in the plane: sums of squares of both singular values,
    their products, and the triangles' areas; NaN where a triangle in space has no area."""
    first, second = positions[:, 1] - positions[:, 0], positions[:, 2] - positions[:, 0]
    length = np.linalg.norm(first, axis=1)
    twice_area = np.linalg.norm(np.cross(first, second), axis=1)
    with np.errstate(divide="ignore", invalid="ignore"):
        along = np.einsum("ij,ij->i", first, second) / length
        column = (uvs[:, 1] - uvs[:, 0]) / length[:, None]
        other = (uvs[:, 2] - uvs[:, 0] - column * along[:, None]) / (twice_area / length)[:, None]
    squares = np.sum(column**2, axis=1) + np.sum(other**2, axis=1)
    determinants = np.abs(column[:, 0] * other[:, 1] - column[:, 1] * other[:, 0])
    return squares, determinants, 0.5 * twice_area


def stretch(positions, uvs):
    """Of triangles as above: the larger of s1 and 1 / s2 under the one scale that makes the whole least distorted (symmetric
    Dirichlet energy); 1 is none. Triangles turned over count as if they were not: mirrored charts are no fault."""
    squares, determinants, areas = squares_and_determinants(positions, uvs)
    usable = np.isfinite(squares) & (determinants > 0) & (areas > 0)
    if not usable.any():
        return np.full(len(squares), WORST)
    f, d, a = squares[usable], determinants[usable], areas[usable]
    scale = (np.sum(a * f / d**2) / np.sum(a * f)) ** 0.25
    root_of_sum, root_of_difference = np.sqrt(f + 2 * d), np.sqrt(np.maximum(f - 2 * d, 0))
    most, least = 0.5 * (root_of_sum + root_of_difference), 0.5 * (root_of_sum - root_of_difference)
    out = np.full(len(squares), WORST)
    with np.errstate(divide="ignore"):
        out[usable] = np.minimum(np.maximum(scale * most, 1 / (scale * least)), WORST)
    return out


def worst_of_faces(values, faces, face_count):
    """The largest value of each face's triangles; 1 where it has none."""
    out = np.ones(face_count)
    np.maximum.at(out, faces, values)
    return out


def colours(values, low, high, worst, opacity):
    """(n, 4) float32 between two RGB colours: `low` at 1, `high` from `worst` on, by the logarithm."""
    part = np.clip(np.log(values) / np.log(worst), 0, 1)[:, None]
    rgb = (1 - part) * np.asarray(low) + part * np.asarray(high)
    return np.concatenate([rgb, np.full((len(values), 1), opacity)], axis=1).astype(np.float32)
