# SPDX-License-Identifier: GPL-3.0-or-later
"""What has to happen to a mesh so that it becomes the engine's cut mesh: which edges are split where, what each corner holds."""

from dataclasses import dataclass

import numpy as np

from .atlas import AtlasArrays


@dataclass(frozen=True)
class EdgeSplit:
    """New vertices on one input edge, from its end `start` on."""

    start: int
    end: int
    vertices: list  # their indices
    fractions: list  # of the edge, increasing


@dataclass(frozen=True)
class CutPlan:
    source: AtlasArrays  # the input: the mesh as it is
    atlas: AtlasArrays  # the mesh as it will be: the input's vertices, then the new ones
    face_sources: np.ndarray  # (F',) the input face that each face is part of
    corner_sources: np.ndarray  # (C', 3) input corners of that face, whose mean a corner is
    corner_weights: np.ndarray  # (C', 3)
    vertex_sources: np.ndarray  # (N, 3) input vertices, whose mean a new vertex is
    vertex_weights: np.ndarray  # (N, 3)
    edge_splits: list
    new_seams: np.ndarray  # (S, 2) vertices: edges of the atlas

    @property
    def input_vertex_count(self):
        return len(self.source.positions)

    def changed_faces(self):
        """The input faces that are divided or gain corners, in order, each with its (first, end) among the faces as they will be."""
        faces = np.repeat(self.face_sources, np.diff(self.atlas.face_offsets))
        gaining = faces[self.atlas.corner_vertices >= self.input_vertex_count]
        divided = self.face_sources[1:][self.face_sources[1:] == self.face_sources[:-1]]
        changed = np.union1d(gaining, divided)
        ends = (np.searchsorted(self.face_sources, changed, side) for side in ("left", "right"))
        return list(zip(changed.tolist(), *(end.tolist() for end in ends), strict=True))

    def corners_of(self, face):
        """The first one, and the end."""
        return self.atlas.face_offsets[face], self.atlas.face_offsets[face + 1]

    def holds_changed(self, uvs, corners):
        """Whether the corners, the plan's, have its UVs in all faces that are changed, to the last bit."""
        changed = np.zeros(len(self.source.face_offsets) - 1, dtype=bool)
        changed[[face for face, _, _ in self.changed_faces()]] = True
        rows = np.repeat(changed[self.face_sources], np.diff(self.atlas.face_offsets))[corners]
        return uvs[rows].tobytes() == self.atlas.corner_uvs[corners][rows].tobytes()

    def uvs_before_division(self):
        """(C, 2) of the input's corners: what those that stay will hold."""
        uvs, stay = self.source.corner_uvs.copy(), self.corner_weights.max(axis=1) == 1
        heaviest = self.corner_weights[stay].argmax(axis=1)
        uvs[self.corner_sources[stay, heaviest]] = self.atlas.corner_uvs[stay]
        return uvs

    def directions(self, source_directions):
        """Unit vectors of the input's corners, such as normals, for the corners of the mesh as it will be."""
        means = _means(source_directions.astype(np.float64), self.corner_sources, self.corner_weights)
        lengths = np.linalg.norm(means, axis=1, keepdims=True)
        heaviest = np.take_along_axis(self.corner_sources, self.corner_weights.argmax(axis=1)[:, None], axis=1)[:, 0]
        return np.where(lengths > 1e-6, means / np.maximum(lengths, 1e-6), source_directions[heaviest])


def plan_cut(source, cut, corner_uvs):
    """The plan that makes `cut` (the engine's CutMesh) out of the AtlasArrays `source`. Raises ValueError where they do not fit
    together, which is a bug of the engine and must not reach a mesh."""
    _check_indices(source, cut, corner_uvs)
    corner_sources, corner_weights = cut.corner_sources, cut.corner_weights
    _check_corner_means(source, cut, corner_sources, corner_weights)
    corner_vertices, first_corners, numbers = _double_new_vertices(source, cut, corner_sources)
    vertex_sources, weights = source.corner_vertices[corner_sources[first_corners]], corner_weights[first_corners]
    positions = source.positions.astype(np.float64)
    positions = np.concatenate([positions, _means(positions, vertex_sources, weights)]).astype(np.float32)
    atlas = AtlasArrays(positions, cut.face_offsets, corner_vertices, corner_uvs)
    _check_places(source, atlas, corner_sources, corner_weights)
    return CutPlan(
        source=source,
        atlas=atlas,
        face_sources=cut.face_sources,
        corner_sources=corner_sources,
        corner_weights=corner_weights,
        vertex_sources=vertex_sources,
        vertex_weights=weights,
        edge_splits=_edge_splits(source, corner_sources[first_corners], weights),
        new_seams=seam_edges(atlas, numbers[cut.new_seams]),
    )


def corners_from_smallest(face_offsets, corner_vertices):
    """The corners face by face, each face from its smallest vertex on: two equal faces that start elsewhere become the same."""
    starts = face_offsets[:-1]
    sizes = np.diff(face_offsets)
    faces = np.repeat(np.arange(len(sizes)), sizes)
    is_smallest = corner_vertices == np.minimum.reduceat(corner_vertices, starts)[faces]
    first = np.empty(len(sizes), dtype=np.int64)
    first[faces[is_smallest]] = np.flatnonzero(is_smallest)
    within = np.arange(len(corner_vertices)) - starts[faces]
    return starts[faces] + (first[faces] - starts[faces] + within) % sizes[faces]


def same_faces(mine, theirs):
    """For each corner of the AtlasArrays `mine` the same one of `theirs`, whose faces may start at other corners; None where
    the faces differ otherwise."""
    if not np.array_equal(mine.face_offsets, theirs.face_offsets):
        return None
    my_order = corners_from_smallest(mine.face_offsets, mine.corner_vertices)
    their_order = corners_from_smallest(theirs.face_offsets, theirs.corner_vertices)
    if not np.array_equal(mine.corner_vertices[my_order], theirs.corner_vertices[their_order]):
        return None
    corners = np.empty_like(their_order)
    corners[my_order] = their_order
    return corners


def _means(values, indices, weights):
    """Weighted means of three rows each."""
    terms = values[indices] * weights[:, :, None]
    return terms[:, 0] + terms[:, 1] + terms[:, 2]


def _require(holds, what):
    if not holds:
        raise ValueError(f"the cut mesh does not fit the mesh: {what}")


def _check_indices(source, cut, corner_uvs):
    vertex_count = len(source.positions) + len(cut.new_vertex_corners)
    offsets, sources = cut.face_offsets, cut.face_sources
    _require(len(offsets) == len(sources) + 1 and offsets[0] == 0 and np.all(np.diff(offsets) >= 3), "faces")
    _require(offsets[-1] == len(cut.corner_vertices) == len(corner_uvs), "corners")
    _require(_in_range(cut.corner_vertices, vertex_count) and _in_range(cut.new_seams, vertex_count), "vertices")
    _require(
        len(np.unique(cut.corner_vertices[cut.corner_vertices >= len(source.positions)])) == len(cut.new_vertex_corners),
        "a new vertex is in no face",
    )
    _require(np.array_equal(np.unique(sources), np.arange(len(source.face_offsets) - 1)), "a face is lost")
    _require(np.all(np.diff(sources) >= 0), "the order of faces")
    faces = np.repeat(np.arange(len(sources)), np.diff(offsets))
    _require(len(np.unique(faces * np.int64(vertex_count) + cut.corner_vertices)) == len(faces), "a face holds a vertex twice")


def _in_range(indices, count):
    return len(indices) == 0 or (indices.min() >= 0 and indices.max() < count)


def _check_corner_means(source, cut, corner_sources, corner_weights):
    """Every corner is the mean of corners of the input face that its face is part of."""
    _require(corner_sources.shape == corner_weights.shape == (len(cut.corner_vertices), 3), "sources of corners")
    faces = np.repeat(cut.face_sources, np.diff(cut.face_offsets))[:, None]
    begin, end = source.face_offsets[faces], source.face_offsets[faces + 1]
    _require(np.all((corner_sources >= begin) & (corner_sources < end)), "a corner lies outside of its face")
    _require(np.all(corner_weights >= 0) and np.all(np.abs(corner_weights.sum(axis=1) - 1) < 1e-9), "weights of corners")


def _check_places(source, atlas, corner_sources, corner_weights):
    """All faces around a vertex have it at one place, those around an input vertex where it was."""
    positions = source.positions.astype(np.float64)
    means = _means(positions, source.corner_vertices[corner_sources], corner_weights).astype(np.float32)
    _require(np.array_equal(means, atlas.positions[atlas.corner_vertices]), "a corner is not where its vertex is")


def _double_new_vertices(source, cut, corner_sources):
    """A new vertex on an edge whose vertices are doubled is doubled as well, or it would sew together what lies apart. Returns the
    corner_vertices, a corner of each new vertex, and the first number of each of the engine's vertices."""
    old_vertices = len(source.positions)
    corners = np.flatnonzero(cut.corner_vertices >= old_vertices)
    rows = np.column_stack([cut.corner_vertices[corners], source.corner_vertices[corner_sources[corners]]])
    distinct, first, inverse = np.unique(rows, axis=0, return_index=True, return_inverse=True)
    corner_vertices = cut.corner_vertices.copy()
    corner_vertices[corners] = old_vertices + inverse.reshape(-1)
    numbers = np.arange(old_vertices + len(cut.new_vertex_corners))
    numbers[old_vertices:] = old_vertices + np.searchsorted(distinct[:, 0], numbers[old_vertices:])
    return corner_vertices, corners[first], numbers


def _places(positions):
    """A number for each vertex, equal where positions are."""
    return np.unique(positions, axis=0, return_inverse=True)[1].reshape(-1)


def seam_edges(atlas, new_seams):
    """The edges that lie where new seams do. Where vertices are doubled a seam has two edges, or goes from one double to the
    other: the engine takes vertices at one position for one."""
    if not len(new_seams):  # which positions are equal takes long to find
        return np.zeros((0, 2), dtype=np.int32)
    places = _places(atlas.positions)
    following = following_corners(atlas.face_offsets)
    edges = np.sort(np.column_stack([atlas.corner_vertices, atlas.corner_vertices[following]]), axis=1)
    keys, wanted = (
        ends.min(axis=1).astype(np.int64) * len(places) + ends.max(axis=1) for ends in (places[edges], places[new_seams])
    )
    _require(np.all(np.isin(wanted, keys)), "a new seam is no edge")
    return np.unique(edges[np.isin(keys, wanted)], axis=0)


def following_corners(face_offsets):
    """For each corner the next one of its face."""
    following = np.arange(1, face_offsets[-1] + 1)
    following[face_offsets[1:] - 1] = face_offsets[:-1]
    return following


def _edge_splits(source, corners, weights):
    """The new vertices on edges of input faces, sorted by edge and along each; those inside of faces are left out, and those on an
    edge without length: the engine takes its two sides for two edges and divides each by itself."""
    following = following_corners(source.face_offsets)
    edges = {}
    for new, (row, three) in enumerate(zip(corners.tolist(), weights.tolist(), strict=True)):
        ends = [(corner, weight) for corner, weight in zip(row, three, strict=True) if weight > 0]
        _require(len(ends) >= 2, "a new vertex is an old one")
        (a, _), (b, weight_b) = ends[:2]
        if len(ends) == 2 and (following[a] == b or following[b] == a):
            start, end = int(source.corner_vertices[a]), int(source.corner_vertices[b])
            fraction = weight_b if start < end else 1 - weight_b
            edges.setdefault((min(start, end), max(start, end)), []).append((fraction, len(source.positions) + new))
    with_length = [ends for ends in sorted(edges) if not np.array_equal(*source.positions[list(ends)])]
    return [_edge_split(ends, sorted(edges[ends])) for ends in with_length]


def _edge_split(ends, vertices):
    fractions = [fraction for fraction, _ in vertices]
    _require(len({0.0, *fractions, 1.0}) == len(fractions) + 2, "new vertices on an edge coincide")
    return EdgeSplit(*ends, [vertex for _, vertex in vertices], fractions)
