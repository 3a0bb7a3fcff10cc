# SPDX-License-Identifier: GPL-3.0-or-later
"""A mesh with one UV map as arrays: what the engine reads."""

import hashlib
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class AtlasArrays:
    positions: np.ndarray  # (V, 3) float32
    face_offsets: np.ndarray  # (F + 1,) int32
    corner_vertices: np.ndarray  # (C,) int32
    corner_uvs: np.ndarray  # (C, 2) float32, as Blender stores them

    @property
    def has_uvs(self):
        """Whether some face has UVs at all its corners."""
        finite = np.isfinite(self.corner_uvs).all(axis=1)
        return len(finite) > 0 and bool(np.logical_and.reduceat(finite, self.face_offsets[:-1]).any())

    def as_tuple(self):
        return self.positions, self.face_offsets, self.corner_vertices, self.corner_uvs

    def fingerprint(self):
        digest = hashlib.sha1(usedforsecurity=False)
        for array in self.as_tuple():
            digest.update(array.tobytes())
        return digest.hexdigest()

    def same_as(self, other):
        """Whether every value is the same, bit for bit."""
        pairs = zip(self.as_tuple(), other.as_tuple(), strict=True)
        return all(mine.shape == theirs.shape and mine.tobytes() == theirs.tobytes() for mine, theirs in pairs)


def stored_uvs(corner_uvs):
    """The engine's float64 UVs as Blender's float32. It certified values that float32 holds exactly: anything else is a bug.

    What was no number before still is none."""
    stored = np.ascontiguousarray(corner_uvs, dtype=np.float32)
    if np.any((stored != corner_uvs) & ~(np.isnan(stored) & np.isnan(corner_uvs))):
        raise ValueError("the refined UVs do not fit single precision")
    return stored
