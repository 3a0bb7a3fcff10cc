# SPDX-License-Identifier: GPL-3.0-or-later
"""Faces that are at fault, for Select UV Problems."""

from typing import NamedTuple

import numpy as np

from ..core.manifold import faces_at_fault


class Kind(NamedTuple):
    label: str
    description: str
    word: str  # follows "3 faces"


#: What find() tells.
KINDS = {
    "overlapping": Kind("Overlapping", "Faces that cover a part of another face in the UV map; stacks too", "overlapping"),
    "flipped": Kind("Flipped", "Faces that are turned over against the rest of their chart", "flipped"),
    "zero_area": Kind("Zero Area", "Faces without area in the UV map", "without area"),
    "unwrapped": Kind("Not Unwrapped", "Charts that are a point or a line in the UV map", "not unwrapped"),
    "mirrored": Kind("Mirrored", "Charts that are turned over as a whole", "mirrored"),
    "non_manifold": Kind(
        "Non-Manifold", "Faces at edges of more than two faces, or wound against their neighbour", "non-manifold"
    ),
    "left": Kind(
        "Left by the Last Run",
        "Charts that the refinement whose result is shown could not use, whatever the reason",
        "left by the last run",
    ),
}


def find(engine, atlas, triangles, name, left):
    """Indices of faces by kind; `triangles`: how Blender divides larger faces; `left`: those that the last refinement left as they
    are."""
    own = {"non_manifold": faces_at_fault(atlas), "left": left}
    if atlas.has_uvs:
        return {**engine.find_problems(*atlas.as_tuple(), triangles=triangles, name=name), **own}
    none = np.zeros(0, dtype=np.int32)
    return {**dict.fromkeys(KINDS, none), "unwrapped": np.arange(len(atlas.face_offsets) - 1), **own}
