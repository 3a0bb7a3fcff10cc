# SPDX-License-Identifier: GPL-3.0-or-later
"""Faces that are at fault, for Select UV Problems."""

import numpy as np

from ..core.manifold import faces_at_fault
from . import mesh as bridge

#: What find() tells, and what a face of the kind is called.
KINDS = {
    "overlapping": "overlapping",
    "flipped": "flipped",
    "zero_area": "zero-area",
    "unwrapped": "not unwrapped",
    "mirrored": "mirrored",
    "non_manifold": "non-manifold",
}


def find(engine, obj, uv_map):
    """Indices of faces by kind."""
    atlas = bridge.read_atlas(obj, uv_map)
    non_manifold = faces_at_fault(atlas)
    if np.isfinite(atlas.corner_uvs).any():
        return {**engine.find_problems(*atlas.as_tuple(), name=obj.name), "non_manifold": non_manifold}
    none = np.zeros(0, dtype=np.int32)
    every = np.arange(len(atlas.face_offsets) - 1)
    return {**dict.fromkeys(KINDS, none), "unwrapped": every, "non_manifold": non_manifold}
