"""Which edges of faces are one in UV space: equal UVs first, then UVs that differ by noise; doubles and folds are told apart."""

import numpy as np

NOISE = 1e-4  # of the tile, or of a smaller atlas
NOISE_OF_EDGE = 0.05  # of the shorter of two UV edges
MOST_SHEETS = 64  # at one edge: more are not told apart
COMPARED = 16  # half-edges next in order of their UVs that each is compared with


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


def groups_of_equal(keys, among):
    """Ranges of `among`, sorted by their rows of keys: (sorted, first of each range, size of each range)."""
    order = among[np.lexsort(keys[among].T[::-1])]
    first = np.flatnonzero(np.r_[True, np.any(keys[order[1:]] != keys[order[:-1]], axis=1)]) if len(order) else np.array([], int)
    return order, first, np.diff(np.r_[first, len(order)])


class Joins:
    """`partner` of each half-edge, -1 where it has none, and whether the two run in `opposite` senses.

    A half-edge has the number of the corner it starts from. `side` is 1 where its face lies left of it in UV space, -1 right."""

    def __init__(self, obj, place, following, face, areas, as_meant):
        self.obj, self.place, self.following, self.face = obj, place, following, face
        self.side = np.sign(areas).astype(int)[face]
        value = np.unique(obj.corner_uv, axis=0, return_inverse=True)[1].reshape(-1)
        here, there = place, place[following]
        self.turned = np.where(here == there, value > value[following], here > there)
        self.left = np.where(self.turned, -self.side, self.side)
        self.low, self.high = (
            np.where(self.turned, following, np.arange(len(face))),
            np.where(self.turned, np.arange(len(face)), following),
        )
        self.partner = np.full(len(face), -1)
        self.opposite = np.zeros(len(face), dtype=bool)
        self.edge = np.unique(np.sort(np.stack([here, there], axis=1), axis=1), axis=0, return_inverse=True)[1].reshape(-1)
        self.ambiguous = []
        vertices = np.sort(np.stack([obj.corner_vertex, obj.corner_vertex[following]], axis=1), axis=1)
        for ends in (vertices, self.edge[:, None]):
            self._join_equal(np.column_stack([ends, value[self.low], value[self.high]]))
        if as_meant:
            self._join_near()
        self._join_ambiguous()

    def _unite(self, one, two, crosswise=False):
        self.partner[one], self.partner[two] = two, one
        self.opposite[one] = self.opposite[two] = (self.turned[one] != self.turned[two]) != crosswise

    def _shape(self, half_edge):
        offsets, face = self.obj.offsets, self.face[half_edge]
        return tuple(sorted(self.place[offsets[face] : offsets[face + 1]].tolist()))

    def _join_equal(self, keys):
        order, first, size = groups_of_equal(keys, np.flatnonzero(self.partner < 0))
        one, two = order[first[size == 2]], order[first[size == 2] + 1]
        bridge = (self.turned[one] != self.turned[two]) & (
            self.obj.corner_vertex[self.low[one]] == self.obj.corner_vertex[self.low[two]]
        )
        apart = (self.left[one] * self.left[two] < 0) & ((self.face[one] != self.face[two]) | bridge)
        self._unite(one[apart], two[apart])
        for a, b in zip(one[~apart].tolist(), two[~apart].tolist(), strict=True):
            self._unite_unless_doubles(a, b)
        for start, count in zip(first[size > 2].tolist(), size[size > 2].tolist(), strict=True):
            self._join_many(np.sort(order[start : start + count]).tolist())

    def _unite_unless_doubles(self, a, b):
        if self.face[a] != self.face[b] and (self.left[a] * self.left[b] < 0 or self._shape(a) != self._shape(b)):
            self._unite(a, b)

    def _join_many(self, uses):
        """Of more than two half-edges on each other those that go on in one sheet."""
        for sense in (1, -1):
            sides = [[h for h in uses if self.side[h] == sense and self.left[h] == left] for left in (1, -1)]
            if all(len({self._shape(h) for h in side}) == 1 for side in sides):
                for a, b in zip(*sides, strict=False):
                    self._unite(a, b)
            elif all(sides):
                self.ambiguous.append(sides)
        rest = [h for h in uses if self.partner[h] < 0]
        if len(rest) == 2 and self.left[rest[0]] * self.left[rest[1]] <= 0:
            self._unite_unless_doubles(*rest)

    def _join_near(self):
        uv = self.obj.corner_uv
        noise = NOISE * min(1.0, float(np.ptp(uv, axis=0).max()))
        keys = np.column_stack([self.edge, uv[self.low], uv[self.high]])
        order, _, _ = groups_of_equal(keys, np.flatnonzero(self.partner < 0))
        left_over = np.bincount(self.edge[order], minlength=int(self.edge.max()) + 1)
        length = np.linalg.norm(uv[self.low] - uv[self.high], axis=1)
        found = []
        for step in range(1, min(COMPARED, int(left_over.max(initial=0)) - 1) + 1):
            a, b = order[:-step], order[step:]
            a, b = (h[(self.edge[a] == self.edge[b]) & (self.face[a] != self.face[b])] for h in (a, b))
            along = np.maximum(*(np.linalg.norm(uv[end[a]] - uv[end[b]], axis=1) for end in (self.low, self.high)))
            across = np.maximum(
                *(np.linalg.norm(uv[p[a]] - uv[q[b]], axis=1) for p, q in ((self.low, self.high), (self.high, self.low)))
            )
            crosswise = (self.place[a] == self.place[self.following[a]]) & (across < along)
            distance = np.where(crosswise, across, along)
            near = (distance > 0) & (distance <= np.minimum(noise, NOISE_OF_EDGE * np.minimum(length[a], length[b])))
            found += zip(distance[near].tolist(), a[near].tolist(), b[near].tolist(), crosswise[near].tolist(), strict=True)
        vertices = np.sort(np.stack([self.obj.corner_vertex, self.obj.corner_vertex[self.following]], axis=1), axis=1)
        layer = self._layers(order, {a for _, a, b, _ in found} | {b for _, a, b, _ in found})
        found = [
            (self.side[a] * self.side[b] < 0, (vertices[a] != vertices[b]).any(), abs(layer[a] - layer[b]), d, a, b, crosswise)
            for d, a, b, crosswise in found
        ]
        for *_, a, b, crosswise in sorted(found):
            apart = self.left[a] * self.left[b] * (-1 if crosswise else 1)
            alone = left_over[self.edge[a]] == 2 and (apart == 0 or self._shape(a) != self._shape(b))
            if self.partner[a] < 0 and self.partner[b] < 0 and (apart < 0 or alone):
                self._unite(a, b, crosswise)

    def _layers(self, among, wanted):
        """How many half-edges of doubles, wound alike in UV space, come before each of the wanted ones at its edge."""
        groups = {}
        for h in sorted(among[np.isin(self.edge[among], self.edge[sorted(wanted)])].tolist()) if wanted else ():
            groups.setdefault(int(self.edge[h]), []).append(h)
        layer = dict.fromkeys(wanted, 0)
        for group in groups.values():
            for h in group if 2 < len(group) <= MOST_SHEETS else ():
                layer[h] = sum(g < h and self.side[g] == self.side[h] and self._shape(g) == self._shape(h) for g in group)
        return layer

    def _join_ambiguous(self):
        """Where one pair of the half-edges is of one chart already, else of one shell: what edges of two faces hold together in space."""
        if not self.ambiguous:
            return
        faces = len(self.obj.offsets) - 1
        one = np.flatnonzero(self.partner > np.arange(len(self.partner)))
        self._join_within(components(faces, self.face[one], self.face[self.partner[one]]))
        order = np.argsort(self.edge, kind="stable")
        first = np.flatnonzero(np.r_[True, np.diff(self.edge[order]) > 0])
        two = first[np.diff(np.r_[first, len(order)]) == 2]
        self._join_within(components(faces, self.face[order[two]], self.face[order[two + 1]]))

    def _join_within(self, part):
        part = part[self.face]
        for sides in self.ambiguous:
            left, right = ([h for h in side if self.partner[h] < 0] for side in sides)
            for a in left:
                others = [b for b in right if part[b] == part[a]]
                if len(others) == 1 and sum(part[c] == part[a] for c in left) == 1:
                    self._unite(a, others[0])
