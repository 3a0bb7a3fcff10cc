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
    "left": "left",
}


def find(engine, obj, uv_map, left):
    """Indices of faces by kind; `left`: those that the last refinement left as they are."""
    atlas = bridge.read_atlas(obj, uv_map)
    own = {"non_manifold": faces_at_fault(atlas), "left": left}
    if np.isfinite(atlas.corner_uvs).any():
        return {**engine.find_problems(*atlas.as_tuple(), name=obj.name), **own}
    none = np.zeros(0, dtype=np.int32)
    return {**dict.fromkeys(KINDS, none), "unwrapped": np.arange(len(atlas.face_offsets) - 1), **own}
