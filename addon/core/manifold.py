# SPDX-License-Identifier: GPL-3.0-or-later
"""Where a mesh is no surface with two sides."""

import numpy as np

from .cuts import following_corners


def faces_at_fault(atlas):
    """Faces at edges of more than two faces, or that run along an edge in the sense in which their neighbour does."""
    start = atlas.corner_vertices.astype(np.int64)
    end = start[following_corners(atlas.face_offsets)]
    faces = np.repeat(np.arange(len(atlas.face_offsets) - 1), np.diff(atlas.face_offsets))
    low, high = np.minimum(start, end), np.maximum(start, end)
    _, edges = np.unique(np.column_stack([low, high]), axis=0, return_inverse=True)
    edges = edges.reshape(-1)
    uses = np.bincount(edges)
    forward = np.bincount(edges, weights=start < end)
    wrong = (uses > 2) | ((uses == 2) & (forward != 1))
    return np.unique(faces[wrong[edges]])
