# SPDX-License-Identifier: GPL-3.0-or-later
"""The meshes of one atlas as one for the engine, and the engine's result dealt out to them again."""

from dataclasses import dataclass, field
from types import SimpleNamespace

import numpy as np

from .atlas import AtlasArrays


@dataclass
class Part:
    """One mesh of an atlas. Faces have flags: who takes part is decided by whole charts."""

    name: str  # of the object
    uv_map: str
    atlas: AtlasArrays
    triangles: np.ndarray  # (T, 3) corners: how Blender divides larger faces
    hidden: np.ndarray  # (F,) bool, here and below
    selected: np.ndarray
    pinned: np.ndarray
    materials: np.ndarray  # (F,) int: a number for each material, the same in all parts
    mesh_name: str = ""
    scale: float = 1.0  # of the object in the world
    keep_shape: np.ndarray | None = None  # (F,) bool
    importance: np.ndarray | None = None  # (F,) float
    no_seam: np.ndarray | None = None  # (n, 2) vertices
    prefer_seam: np.ndarray | None = None
    taken: np.ndarray = field(init=False)  # (F,) bool: given to the engine

    def __post_init__(self):
        self.taken = np.ones(len(self.atlas.face_offsets) - 1, dtype=bool)


class Joined:
    """Parts as one mesh: faces that are taken, each part at a place in space of its own so that no two are sewn together."""

    def __init__(self, parts):
        self.parts = parts
        self.faces = [np.flatnonzero(part.taken) for part in parts]
        self.corners = [corners_of(part.atlas.face_offsets, faces) for part, faces in zip(parts, self.faces, strict=True)]
        self.first_vertices = np.cumsum([0] + [len(part.atlas.positions) for part in parts])
        self.first_corners = np.cumsum([0] + [len(corners) for corners in self.corners])
        self.first_faces = np.cumsum([0] + [len(faces) for faces in self.faces])

    def arrays(self):
        """The four array arguments of the engine."""
        pairs = list(zip(self.parts, self.faces, self.corners, strict=True))
        sizes = np.concatenate([np.diff(part.atlas.face_offsets)[faces] for part, faces, _ in pairs])
        vertices = [part.atlas.corner_vertices[c] + first for (part, _, c), first in self._with(self.first_vertices)]
        uvs = np.concatenate([part.atlas.corner_uvs[corners] for part, _, corners in pairs])
        return self._positions(), np.concatenate([[0], np.cumsum(sizes)]), np.concatenate(vertices), uvs

    def _with(self, firsts):
        return zip(zip(self.parts, self.faces, self.corners, strict=True), firsts, strict=False)

    @property
    def unit(self):
        """How long a unit of arrays() is in the world."""
        return self.parts[0].scale if len(self.parts) == 1 else 1.0

    def _positions(self):
        if len(self.parts) == 1:
            return self.parts[0].atlas.positions
        out, right = [], 0.0
        for part in self.parts:
            positions = part.atlas.positions.astype(np.float64) * part.scale
            places = positions[np.isfinite(positions[:, 0]), 0]
            if len(places):
                positions[:, 0] += right - places.min()
                right += np.ptp(places) + 1.0
            out.append(positions)
        return np.concatenate(out)

    def of_faces(self, values):
        """One array of a value per face of the taken faces, from one per part."""
        return np.concatenate([value[faces] for value, faces in zip(values, self.faces, strict=True)])

    def values(self, name, otherwise):
        """The values per taken face that parts name, `otherwise` in the other parts; None where no part does."""
        named = [getattr(part, name) for part in self.parts]
        if all(values is None for values in named):
            return None
        pairs = zip(self.parts, named, strict=True)
        return self.of_faces([np.full(len(part.taken), otherwise) if values is None else values for part, values in pairs])

    def triangles(self):
        out = []
        for (part, _, corners), first in self._with(self.first_corners):
            own = part.triangles if part.taken.all() else renumbered(part.triangles, corners, len(part.atlas.corner_vertices))
            out.append(first + own)
        return np.concatenate(out)

    def edges(self, name):
        """(n, 2) vertices of the edges that parts name, None where none does."""
        named = [(getattr(part, name), first) for part, first in zip(self.parts, self.first_vertices, strict=False)]
        rows = [edges.reshape(-1, 2) + first for edges, first in named if edges is not None]
        return np.concatenate(rows) if rows else None

    def uvs_of(self, k, corner_uvs):
        """The part's UVs with the engine's (float32) in the corners that it was given."""
        uvs = self.parts[k].atlas.corner_uvs.copy()
        uvs[self.corners[k]] = corner_uvs[self.first_corners[k] : self.first_corners[k + 1]]
        return uvs

    def faces_of(self, k, flags):
        """Numbers of the part's faces that a flag per face of the whole is set for."""
        return self.faces[k][flags[self.first_faces[k] : self.first_faces[k + 1]]]

    def seams_of(self, k, seams):
        """Those of (S, 2) vertices that lie in the part, in its numbers."""
        own = np.all((seams >= self.first_vertices[k]) & (seams < self.first_vertices[k + 1]), axis=1)
        return seams[own] - self.first_vertices[k]

    def cut_of(self, k, cut, corner_uvs):
        """(the engine's CutMesh as that of one part, the UVs of its corners); all faces of the part must be taken."""
        begin, end = np.searchsorted(cut.face_sources, self.first_faces[k : k + 2])
        corners = slice(int(cut.face_offsets[begin]), int(cut.face_offsets[end]))
        first, count = self.first_vertices[k], len(self.parts[k].atlas.positions)
        vertices = cut.corner_vertices[corners].astype(np.int64)
        total = self.first_vertices[-1]
        new = np.unique(vertices[vertices >= total])
        numbers = np.full(total + len(cut.new_vertex_corners), -1)
        numbers[first : first + count] = np.arange(count)
        numbers[new] = count + np.arange(len(new))
        seams = numbers[cut.new_seams].reshape(-1, 2)
        own = SimpleNamespace(
            face_offsets=cut.face_offsets[begin : end + 1] - cut.face_offsets[begin],
            corner_vertices=numbers[vertices].astype(np.int32),
            face_sources=(cut.face_sources[begin:end] - self.first_faces[k]).astype(np.int32),
            corner_sources=(cut.corner_sources[corners] - self.first_corners[k]).astype(np.int32),
            corner_weights=cut.corner_weights[corners],
            new_vertex_corners=cut.new_vertex_corners[new - total] - self.first_corners[k],
            new_seams=seams[np.all(seams >= 0, axis=1)].astype(np.int32),
        )
        return own, corner_uvs[corners]


def corners_of(face_offsets, faces):
    """Numbers of the corners of these faces, face by face."""
    sizes = np.diff(face_offsets)[faces]
    first = np.cumsum(sizes) - sizes
    return np.repeat(face_offsets[:-1][faces] - first, sizes) + np.arange(sizes.sum())


def renumbered(triangles, corners, corner_count):
    """(T, 3) corners, of so many, as numbers among `corners`: those of triangles that have all three there."""
    number = np.full(corner_count, -1)
    number[corners] = np.arange(len(corners))
    rows = number[triangles].reshape(-1, 3)
    return rows[np.all(rows >= 0, axis=1)]
