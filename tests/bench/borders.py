"""The borders of charts: where they cross or touch, how near they come, what lies inside what."""

import math

import numpy as np
from exact import exact_orientation, exactly_touch, folds_back, orientation
from topology import components

NEAR = 1e-9  # of the coordinates' size: closer than this only rational arithmetic decides
PAIRS_AT_ONCE = 2_000_000


def point_to_segment(p, a, b):
    along = b - a
    length2 = np.einsum("ij,ij->i", along, along)
    t = np.einsum("ij,ij->i", p - a, along) / np.where(length2 > 0, length2, 1)
    return np.linalg.norm(p - a - np.clip(t, 0, 1)[:, None] * along, axis=1)


def segment_distance(p, q, r, s):
    """Distance of segments pq and rs, 0 where they cross."""
    ends = ((p, r, s), (q, r, s), (r, p, q), (s, p, q))
    distance = np.minimum.reduce([point_to_segment(*case) for case in ends])

    def turn(a, b, c):
        return (b[:, 0] - a[:, 0]) * (c[:, 1] - a[:, 1]) - (b[:, 1] - a[:, 1]) * (c[:, 0] - a[:, 0])

    crossing = (turn(p, q, r) * turn(p, q, s) < 0) & (turn(r, s, p) * turn(r, s, q) < 0)
    return np.where(crossing, 0, distance)


def near_pairs(a, b, reach):
    """Yields index arrays i, j with every pair of segments no farther than `reach` apart among them, some twice."""
    if not len(a):
        return
    length = np.linalg.norm(b - a, axis=1)
    piece = max(reach, float(np.mean(length)))
    pieces = np.maximum(1, np.ceil(length / piece)).astype(int)
    owner = np.repeat(np.arange(len(a)), pieces)
    step = np.arange(len(owner)) - np.repeat(np.cumsum(pieces) - pieces, pieces)
    middle = a[owner] + ((step + 0.5) / pieces[owner])[:, None] * (b - a)[owner]
    cell = np.floor((middle - middle.min(axis=0)) / (reach + piece)).astype(np.int64)
    row = int(cell[:, 0].max()) + 3
    key = cell[:, 1] * row + cell[:, 0] + 1
    order = np.argsort(key, kind="stable")
    key, owner, middle = key[order], owner[order], middle[order]
    for offset in (0, 1, row - 1, row, row + 1):
        low = np.arange(len(key)) + 1 if offset == 0 else np.searchsorted(key, key + offset, "left")
        count = np.searchsorted(key, key + offset, "right") - low
        total = np.cumsum(count)
        start = 0
        while start < len(key):
            end = max(start + 1, int(np.searchsorted(total, (total[start - 1] if start else 0) + PAIRS_AT_ONCE)))
            n = count[start:end]
            i = np.repeat(np.arange(start, end), n)
            j = np.repeat(low[start:end] - (np.cumsum(n) - n), n) + np.arange(len(i))
            close = np.linalg.norm(middle[i] - middle[j], axis=1) <= reach + piece
            i, j = owner[i[close]], owner[j[close]]
            yield i[i != j], j[i != j]
            start = end


class Boundary:
    """The charts' borders as segments, with the questions asked of them; distances are measured with u stretched by `width`."""

    def __init__(self, obj, topology, width=1.0):
        edges = topology.boundary
        with_sense = topology.sense[topology.face[edges]] > 0
        first = np.where(with_sense, edges, topology.next[edges])
        last = np.where(with_sense, topology.next[edges], edges)
        self.start, self.end = topology.node[first], topology.node[last]
        self.start_point, self.end_point = self._points(obj, topology, first, last)
        self.a, self.b = obj.corner_uv[first], obj.corner_uv[last]
        stretched = obj.corner_uv * (width, 1)
        self.measured_a, self.measured_b = stretched[first], stretched[last]
        self.chart = topology.chart[topology.face[edges]]
        self.size = float(np.abs(stretched).max()) + float(np.ptp(stretched, axis=0).max())
        leaving = np.full(len(topology.node), -1)
        leaving[self.start] = np.arange(len(edges))
        self.following = leaving[self.end]
        self.loop = components(len(edges), np.arange(len(edges)), self.following)

    @staticmethod
    def _points(obj, topology, first, last):
        """A number for the start and the end of each border edge: one for all vertices of a chart at one point in space and UVs."""
        at = np.r_[first, last]
        keys = np.column_stack([topology.chart[topology.face[at]], topology.place[at], obj.corner_uv[at]])
        return np.split(np.unique(keys, axis=0, return_inverse=True)[1].reshape(-1), 2)

    def pairs(self, i, j):
        return self.a[i], self.b[i], self.a[j], self.b[j]

    def near(self, reach, of_two_charts=False):
        """Yields index arrays i, j as near_pairs() does, and the distances."""
        a, b = self.measured_a, self.measured_b
        for i, j in near_pairs(a, b, reach):
            if of_two_charts:
                other = self.chart[i] != self.chart[j]
                i, j = i[other], j[other]
            yield i, j, segment_distance(a[i], b[i], a[j], b[j])

    def contacts_and_gap(self, least_reach):
        """Pairs of edges that cross or touch, and the smallest distance between two charts (inf with one)."""
        contacts, gap = set(self._folds()) | set(self._crossing_fans()), math.inf
        lengths = np.linalg.norm(self.measured_b - self.measured_a, axis=1)
        reach = max(least_reach, float(np.sum(lengths)) / max(1, len(lengths)) / 2)
        for i, j, distance in self.near(reach):
            linked = (self.end[i] == self.start[j]) | (self.end[j] == self.start[i])
            for k in np.flatnonzero((distance <= NEAR * self.size) & ~linked):
                one, two = sorted((int(i[k]), int(j[k])))
                if (one, two) not in contacts and self._in_contact(one, two):
                    contacts.add((one, two))
            gap = min(gap, self._between(i, j, distance))
        while gap > reach and reach < 4 * self.size and self.chart.max(initial=0) > 0:
            reach *= 2
            for i, j, distance in self.near(reach, of_two_charts=True):
                gap = min(gap, self._between(i, j, distance))
        return contacts, gap

    def _in_contact(self, i, j):
        """Edges that touch, but for those with one end at a point where their chart is pinched: they must not lie on each other."""
        ends = [(self.start_point[i], self.a[i], self.b[i]), (self.end_point[i], self.b[i], self.a[i])]
        others = [(self.start_point[j], self.b[j]), (self.end_point[j], self.a[j])]
        shared = [(at, far, other) for point, at, far in ends for point_of_other, other in others if point == point_of_other]
        if len(shared) != 1:
            return exactly_touch(*self.pairs(i, j))
        at, far, other = shared[0]
        return folds_back(far, at, other)

    def _crossing_fans(self):
        """Edges into vertices at one point (a pinch) whose faces there reach into each other."""
        order = np.argsort(self.end_point, kind="stable")
        first = np.flatnonzero(np.r_[True, np.diff(self.end_point[order]) > 0])
        for into in np.split(order, first[1:]):
            for k, i in enumerate(into.tolist()):
                for j in into[k + 1 :].tolist():
                    if not self._in_turn(i, j):
                        yield min(i, j), max(i, j)

    def _in_turn(self, i, j):
        """Whether out of i, into i, out of j, into j come in this order around the point that both run into."""
        at = self.b[i]
        out_of_i, into_i, out_of_j, into_j = self.b[self.following[i]], self.a[i], self.b[self.following[j]], self.a[j]

        def turns(p, q, r):
            """p, q, r come counter-clockwise around `at`, all different directions."""
            return sum(exact_orientation(at, *pair) > 0 for pair in ((p, q), (q, r), (r, p))) >= 2

        return turns(out_of_i, into_i, out_of_j) and turns(out_of_i, out_of_j, into_j) and turns(into_i, out_of_j, into_j)

    def _between(self, i, j, distance):
        other = self.chart[i] != self.chart[j]
        return float(distance[other].min()) if other.any() else math.inf

    def _folds(self):
        """Neighbours along a border that lie on each other."""
        c = self.b[self.following]
        turn = np.abs((self.b - self.a)[:, 0] * (c - self.b)[:, 1] - (self.b - self.a)[:, 1] * (c - self.b)[:, 0])
        flat = turn <= NEAR * np.linalg.norm(self.b - self.a, axis=1) * np.linalg.norm(c - self.b, axis=1)
        for i in np.flatnonzero(flat):
            if folds_back(self.a[i], self.b[i], c[i]) or self.following[self.following[i]] == i:
                yield tuple(sorted((int(i), int(self.following[i]))))

    def overlapping_loops(self):
        """Loops on whose inner side the atlas does not lie exactly once; borders must not touch each other.

        The other loops wind 0 times around a point of an outer loop and once around a point of a hole: its first vertex that is
        alone at its point, else the middle of its longest edge."""
        count = int(self.loop.max(initial=-1)) + 1
        area2 = np.bincount(self.loop, self.a[:, 0] * self.b[:, 1] - self.a[:, 1] * self.b[:, 0], count)
        length = np.linalg.norm(self.b - self.a, axis=1)
        pinched = np.bincount(self.start_point)[self.start_point] > 1
        low, high = np.minimum(self.a[:, 1], self.b[:, 1]), np.maximum(self.a[:, 1], self.b[:, 1])
        wrong = []
        for loop in range(count):
            own = np.flatnonzero(self.loop == loop)
            alone = own[~pinched[own]]
            longest = own[np.argmax(length[own])]
            p = self.a[alone[0]] if len(alone) else (self.a[longest] + self.b[longest]) / 2
            hit = np.flatnonzero((low <= p[1]) & (high > p[1]) & (self.loop != loop))
            a, b = self.a[hit], self.b[hit]
            up = np.where(b[:, 1] > a[:, 1], 1, -1)
            right_of_point = orientation(a, b, np.broadcast_to(p, a.shape)) == up
            if int(np.sum(up[right_of_point])) != (0 if area2[loop] > 0 else 1):
                wrong.append(loop)
        return wrong
