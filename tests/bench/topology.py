"""How the faces of an atlas hang together in UV space: partners of edges, charts, seams, which way faces are wound."""

import numpy as np
from joins import NOISE, NOISE_OF_EDGE, Joins, components


class Topology:
    """How the faces hang together in UV space. A half-edge has the number of the corner it starts from.

    Two half-edges are partners where they have the same ends (as vertices, else as positions) and the same UVs there; `as_meant`
    also where those differ by noise."""

    def __init__(self, obj, as_meant=False):
        corners, faces = len(obj.corner_vertex), len(obj.offsets) - 1
        self.next = np.arange(corners) + 1
        self.next[obj.offsets[1:] - 1] = obj.offsets[:-1]
        self.face = np.repeat(np.arange(faces), np.diff(obj.offsets))
        self._join(obj, as_meant)
        one = np.flatnonzero(self.partner > np.arange(corners))
        two = self.partner[one]
        opposite = self.opposite[one]
        two_start, two_end = np.where(opposite, self.next[two], two), np.where(opposite, two, self.next[two])
        self.node = components(corners, np.r_[one, self.next[one]], np.r_[two_start, two_end])
        self.chart = components(faces, self.face[one], self.face[two])
        if as_meant:
            self._close_two_sided_holes(obj.corner_uv)
        self.sense = self._senses(obj, one, two)
        self.boundary = np.flatnonzero(self.partner < 0)

    def _join(self, obj, as_meant):
        self.place = place = np.unique(obj.positions + 0.0, axis=0, return_inverse=True)[1].reshape(-1)[obj.corner_vertex]
        joins = Joins(obj, place, self.next, self.face, face_areas(obj, self.next), as_meant)
        self.partner, self.opposite = joins.partner, joins.opposite
        self.fold = (self.partner >= 0) & (joins.side * joins.side[self.partner] * np.where(self.opposite, 1, -1) <= 0)
        edges = np.sort(np.stack([place, place[self.next]], axis=1), axis=1)
        edge = np.unique(edges, axis=0, return_inverse=True)[1]
        shared, joined = np.bincount(edge), np.bincount(edge, self.partner >= 0)
        seam = (shared > 1) & (joined < shared) & (shared > np.bincount(edge, place == place[self.next]))
        at = np.unique(edge, return_index=True)[1][seam]
        p, used = obj.positions[obj.corner_vertex], obj.positions
        self.seams = len(at)
        self.seam_length = float(np.linalg.norm(p[self.next[at]] - p[at], axis=1).sum() / np.linalg.norm(np.ptp(used, axis=0)))

    def _close_two_sided_holes(self, uv):
        """Where all other faces around both ends are joined, the two sides of an edge are: no hole has two sides."""
        ends = {}
        for c in np.flatnonzero(self.partner < 0):
            ends.setdefault((self.node[c], self.node[self.next[c]]), []).append(c)
        for (start, end), own in ends.items():
            others = ends.get((end, start), [])
            if start > end or len(own) != 1 or len(others) != 1:
                continue
            here, there = own[0], others[0]
            apart = np.linalg.norm(uv[[here, self.next[here]]] - uv[[self.next[there], there]], axis=1).max()
            if apart < min(np.linalg.norm(uv[c] - uv[self.next[c]]) for c in (here, there)):
                self.partner[here], self.partner[there] = there, here
                self.opposite[[here, there]] = True

    def _gaps(self, obj):
        """How far apart the UVs of another file with the same faces are across each joined edge: the larger of both ends."""
        here, there = self.partner, self.next[self.partner]
        start, end = np.where(self.opposite, there, here), np.where(self.opposite, here, there)
        uv = obj.corner_uv
        gaps = np.maximum(np.linalg.norm(uv - uv[start], axis=1), np.linalg.norm(uv[self.next] - uv[end], axis=1))
        return np.where(self.partner >= 0, gaps, 0)

    def settled(self, obj):
        """The UVs with one value where they differ by noise: at the corners of a vertex that of the first, at the vertices of a chart
        that are one point in space (a pinch) that of the first of them."""
        uv = obj.corner_uv
        first = np.unique(self.node, return_index=True)[1]
        at = np.stack([self.chart[self.face[first]], self.place[first]], axis=1)
        pinched = first[np.unique(at, axis=0, return_index=True)[1][np.unique(at, axis=0, return_inverse=True)[1].reshape(-1)]]
        edge = np.full(len(first), np.inf)
        length = np.linalg.norm(uv[self.next] - uv, axis=1)
        for end in (self.node, self.node[self.next]):
            np.minimum.at(edge, end, length)
        noise = np.minimum(self.noise_of(obj), NOISE_OF_EDGE * np.minimum(edge, edge[self.node[pinched]]))
        near = np.linalg.norm(uv[first] - uv[pinched], axis=1) <= noise
        return uv[np.where(near, pinched, first)][self.node]

    @staticmethod
    def noise_of(obj):
        return NOISE * min(1.0, float(np.ptp(obj.corner_uv, axis=0).max()))

    def apart(self, obj):
        return self._gaps(obj) > 0

    def noticeably_apart(self, obj):
        return self._gaps(obj) > self.noise_of(obj)

    def _senses(self, obj, one, two):
        """1 for every face, but -1 for the faces of a chart that are wound against the larger part of it."""
        faces = len(obj.offsets) - 1
        f, g = self.face[one], self.face[two]
        flip = np.where(self.opposite[one], 0, faces)
        side = components(2 * faces, np.r_[f, f + faces], np.r_[g + flip, (g + flip + faces) % (2 * faces)])
        self.one_sided = (side[:faces] == side[faces:])[self.face]
        first = np.unique(self.chart, return_index=True)[1]
        sense = np.where(side[:faces] == side[first[self.chart]], 1, -1)
        mixed = np.bincount(self.chart, sense < 0) > 0
        against = mixed & (np.bincount(self.chart, sense * face_areas(obj, self.next)) < 0)
        return np.where(against[self.chart], -sense, sense)


def face_areas(obj, following):
    uv = obj.corner_uv - np.repeat(obj.corner_uv[obj.offsets[:-1]], np.diff(obj.offsets), axis=0)
    return np.add.reduceat(uv[:, 0] * uv[following, 1] - uv[:, 1] * uv[following, 0], obj.offsets[:-1]) / 2
