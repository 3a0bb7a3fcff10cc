"""How the faces of an atlas hang together in UV space: partners of edges, charts, seams, which way faces are wound."""

import numpy as np


def components(count, a, b):
    """Label of each of `count` items, equal where a chain of links a[i] - b[i] joins them."""
    label = np.arange(count)
    while True:
        low = np.minimum(label[a], label[b])
        joined = label.copy()
        np.minimum.at(joined, label[a], low)
        np.minimum.at(joined, label[b], low)
        while not np.array_equal(joined, joined[joined]):
            joined = joined[joined]
        if np.array_equal(joined, label):
            return np.unique(label, return_inverse=True)[1]
        label = joined


def pairs_of_equal(keys, among):
    """Every two of the rows `among` whose keys are equal, where exactly two are."""
    order = among[np.lexsort(keys[among].T[::-1])]
    first = np.flatnonzero(np.r_[True, np.any(keys[order[1:]] != keys[order[:-1]], axis=1)])
    size = np.diff(np.r_[first, len(order)])
    return order[first[size == 2]], order[first[size == 2] + 1]


class Topology:
    """How the faces hang together in UV space. A half-edge has the number of the corner it starts from.

    Two half-edges are partners where they have the same ends (as vertices, else as positions) and the same UVs there."""

    def __init__(self, obj):
        corners, faces = len(obj.corner_vertex), len(obj.offsets) - 1
        self.next = np.arange(corners) + 1
        self.next[obj.offsets[1:] - 1] = obj.offsets[:-1]
        self.face = np.repeat(np.arange(faces), np.diff(obj.offsets))
        self._join(obj)
        one = np.flatnonzero(self.partner > np.arange(corners))
        two = self.partner[one]
        opposite = self.opposite[one]
        two_start, two_end = np.where(opposite, self.next[two], two), np.where(opposite, two, self.next[two])
        self.node = components(corners, np.r_[one, self.next[one]], np.r_[two_start, two_end])
        self.chart = components(faces, self.face[one], self.face[two])
        self.sense = self._senses(obj, one, two)
        self.boundary = np.flatnonzero(self.partner < 0)

    def _join(self, obj):
        value = np.unique(obj.corner_uv, axis=0, return_inverse=True)[1]
        place = np.unique(obj.positions + 0.0, axis=0, return_inverse=True)[1][obj.corner_vertex]
        left = face_areas(obj, self.next) > 0
        self.partner = np.full(len(value), -1)
        self.opposite = np.zeros(len(value), dtype=bool)
        for ends in (obj.corner_vertex, place):
            here, there = ends, ends[self.next]
            turned = here > there
            low, high = np.where(turned, value[self.next], value), np.where(turned, value, value[self.next])
            keys = np.stack([np.minimum(here, there), np.maximum(here, there), low, high], axis=1)
            one, two = pairs_of_equal(keys, np.flatnonzero(self.partner < 0))
            opposite = turned[one] != turned[two]
            if ends is place:  # the front and the back of a sheet are not joined
                apart = opposite == (left[self.face[one]] == left[self.face[two]])
                one, two, opposite = one[apart], two[apart], opposite[apart]
            self.partner[one], self.partner[two] = two, one
            self.opposite[one] = self.opposite[two] = opposite
        edges = np.sort(np.stack([place, place[self.next]], axis=1), axis=1)
        edge = np.unique(edges, axis=0, return_inverse=True)[1]
        shared, joined = np.bincount(edge), np.bincount(edge, self.partner >= 0)
        seam = (shared > 1) & (joined < shared) & (shared > np.bincount(edge, place == place[self.next]))
        at = np.unique(edge, return_index=True)[1][seam]
        p, used = obj.positions[obj.corner_vertex], obj.positions
        self.seams = len(at)
        self.seam_length = float(np.linalg.norm(p[self.next[at]] - p[at], axis=1).sum() / np.linalg.norm(np.ptp(used, axis=0)))

    def _senses(self, obj, one, two):
        """1 for every face, but -1 for the faces of a chart that are wound against the larger part of it."""
        faces = len(obj.offsets) - 1
        f, g = self.face[one], self.face[two]
        flip = np.where(self.opposite[one], 0, faces)
        side = components(2 * faces, np.r_[f, f + faces], np.r_[g + flip, (g + flip + faces) % (2 * faces)])
        first = np.unique(self.chart, return_index=True)[1]
        sense = np.where(side[:faces] == side[first[self.chart]], 1, -1)
        mixed = np.bincount(self.chart, sense < 0) > 0
        against = mixed & (np.bincount(self.chart, sense * face_areas(obj, self.next)) < 0)
        return np.where(against[self.chart], -sense, sense)


def face_areas(obj, following):
    uv = obj.corner_uv - np.repeat(obj.corner_uv[obj.offsets[:-1]], np.diff(obj.offsets), axis=0)
    return np.add.reduceat(uv[:, 0] * uv[following, 1] - uv[:, 1] * uv[following, 0], obj.offsets[:-1]) / 2
