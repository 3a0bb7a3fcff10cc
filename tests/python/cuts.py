"""Hand-made cut meshes: a mesh cut by lines in its plane, as the engine's CutMesh would hold them."""

import itertools
from types import SimpleNamespace

import numpy as np


class Cutter:
    """Cuts chosen convex faces along lines x = c or y = c of the xy-plane; the other faces only gain corners."""

    def __init__(self, positions, face_offsets, corner_vertices, corner_uvs):
        self.positions = np.asarray(positions, dtype=np.float64)
        self.offsets = np.asarray(face_offsets)
        self.corners = np.asarray(corner_vertices)
        self.uvs = np.asarray(corner_uvs, dtype=np.float64)
        self.points = [point[:2] for point in self.positions]
        self.by_point = {}  # of new vertices
        self.new_corners, self.new_weights, self.seams = [], [], set()
        self.pieces = [[self.corners[b:e].tolist()] for b, e in itertools.pairwise(self.offsets)]

    def cut(self, axis, at, faces=None, below=np.inf):
        """Cuts the faces (None: all) along the line, of their pieces those whose middle is below on the other axis; returns
        self."""
        for face in range(len(self.pieces)) if faces is None else faces:
            rows = [
                self._halves(face, piece, axis, at) if self._middle(piece)[1 - axis] < below else [piece]
                for piece in self.pieces[face]
            ]
            self.pieces[face] = [piece for row in rows for piece in row]
        return self

    def result(self, shift=0.0):
        """(cut, corner_uvs): the CutMesh and the refined UVs, single precision: piece k of each face moved by k * shift."""
        faces = [
            (source, self._with_edge_points(piece), k) for source, row in enumerate(self.pieces) for k, piece in enumerate(row)
        ]
        means = [self._mean(source, vertex) for source, piece, _ in faces for vertex in piece]
        shifts = [k * shift for _, piece, k in faces for _ in piece]
        uvs = [np.dot(weights, self.uvs[sources]) + [by, 0.0] for (sources, weights), by in zip(means, shifts, strict=True)]
        cut = SimpleNamespace(
            face_offsets=np.cumsum([0] + [len(piece) for _, piece, _ in faces]).astype(np.int32),
            corner_vertices=np.array([vertex for _, piece, _ in faces for vertex in piece], dtype=np.int32),
            face_sources=np.array([source for source, _, _ in faces], dtype=np.int32),
            corner_sources=np.array([sources for sources, _ in means], dtype=np.int32),
            corner_weights=np.array([weights for _, weights in means]),
            new_vertex_corners=np.array(self.new_corners, dtype=np.int32).reshape(-1, 3),
            new_vertex_weights=np.array(self.new_weights, dtype=np.float64).reshape(-1, 3),
            new_seams=np.array(self._final_seams(faces), dtype=np.int32).reshape(-1, 2),
        )
        return cut, np.array(uvs, dtype=np.float32)

    def _middle(self, piece):
        return np.mean([self.points[vertex] for vertex in piece], axis=0)

    def _halves(self, face, piece, axis, at):
        sides = [np.sign(self.points[vertex][axis] - at) for vertex in piece]
        if min(sides) >= 0 or max(sides) <= 0:
            return [piece]
        low, high, crossing = [], [], []
        for i, vertex in enumerate(piece):
            following = piece[(i + 1) % len(piece)]
            for half, side in ((low, -1), (high, 1)):
                if sides[i] in (0, side):
                    half.append(vertex)
            if sides[i] == 0:
                crossing.append(vertex)
            if sides[i] * sides[(i + 1) % len(piece)] < 0:
                new = self._crossing(face, vertex, following, axis, at)
                low.append(new)
                high.append(new)
                crossing.append(new)
        self.seams.add(tuple(crossing))
        return [low, high]

    def _crossing(self, face, a, b, axis, at):
        t = (at - self.points[a][axis]) / (self.points[b][axis] - self.points[a][axis])
        point = self.points[a] + t * (self.points[b] - self.points[a])
        point[axis] = at
        key = tuple(np.round(point, 9))
        if key not in self.by_point:
            self.by_point[key] = len(self.points)
            self.points.append(point)
            corners, weights = self._source(face, point)
            self.new_corners.append(corners)
            self.new_weights.append(weights)
        return self.by_point[key]

    def _source(self, face, point):
        """Corners and weights of a point of a face: of an edge, else of a triangle of its fan."""
        begin, end = self.offsets[face], self.offsets[face + 1]
        around = list(range(begin, end))
        for a, b in zip(around, around[1:] + around[:1], strict=True):
            from_a, along = point - self.points[self.corners[a]], self.points[self.corners[b]] - self.points[self.corners[a]]
            t = from_a @ along / (along @ along)
            if abs(from_a[0] * along[1] - from_a[1] * along[0]) < 1e-12 and 0 < t < 1:
                return [a, b, next(c for c in around if c not in (a, b))], [1 - t, t, 0.0]
        for b, c in itertools.pairwise(around[1:]):
            three = [begin, b, c]
            matrix = np.vstack([np.array([self.points[self.corners[k]] for k in three]).T, np.ones(3)])
            flat = abs(np.linalg.det(matrix)) < 1e-12
            weights = np.array([-1.0]) if flat else np.linalg.solve(matrix, [*point, 1.0])
            if weights.min() >= -1e-12:
                weights = np.maximum(weights, 0.0)
                return three, (weights / weights.sum()).tolist()
        raise AssertionError("the point is outside of the face")

    def _with_edge_points(self, piece):
        """The piece with every new vertex that lies on one of its edges."""
        full = []
        for a, b in zip(piece, piece[1:] + piece[:1], strict=True):
            full += [a, *self._between(a, b)]
        return full

    def _between(self, a, b):
        start, along = self.points[a], self.points[b] - self.points[a]
        found = []
        for vertex in self.by_point.values():
            offset = self.points[vertex] - start
            t = offset @ along / (along @ along)
            if vertex not in (a, b) and 0 < t < 1 and abs(offset[0] * along[1] - offset[1] * along[0]) < 1e-12:
                found.append((t, vertex))
        return [vertex for _, vertex in sorted(found)]

    def _final_seams(self, faces):
        edges = {frozenset(pair) for _, piece, _ in faces for pair in zip(piece, piece[1:] + piece[:1], strict=True)}
        chains = [[a, *self._between(a, b), b] for a, b in self.seams]
        return sorted(tuple(sorted(pair)) for chain in chains for pair in itertools.pairwise(chain) if frozenset(pair) in edges)

    def _mean(self, face, vertex):
        """(corners of the face, weights) whose mean the vertex is."""
        here = {self.corners[corner]: corner for corner in range(self.offsets[face], self.offsets[face + 1])}
        if vertex < len(self.positions):
            return [here[vertex]] * 3, [1.0, 0.0, 0.0]
        new = vertex - len(self.positions)
        weights = self.new_weights[new]
        heaviest = self.new_corners[new][np.argmax(weights)]
        sources = [corner if weight > 0 else heaviest for corner, weight in zip(self.new_corners[new], weights, strict=True)]
        return [here[self.corners[corner]] for corner in sources], weights
