#!/usr/bin/env python3
"""Checks a refined OBJ against its input without using the library: file kept, no new seam, valid, PE, gap, distortion.

    check_atlas.py IN.obj OUT.obj [--pe-bound B] [--aspect W/H] [--gap FRACTION] [--gap-unit diagonal|long_side] [--cuts]

With --cuts seams may be added and faces divided; then the parts of each face must tile it, with everything else kept.

Prints one JSON line; exit code 0 where everything holds, 1 where not, 2 where a file cannot be read. Needs numpy only. Signs are
decided in floating point where that is safe and in rational arithmetic where it is not.
"""

import argparse
import json
import math
import sys
import time
from pathlib import Path

import numpy as np
from check_cut import divided, joined_anew
from exact import exactly_touch, folds_back, orientation, polygon_is_simple
from obj_text import one_after_the_other, read_obj
from triangles import distortion, fan_triangles, least_energy_triangles

NEAR = 1e-9  # of the coordinates' size: closer than this only rational arithmetic decides
PAIRS_AT_ONCE = 2_000_000


# ---------------------------------------------------------------------------------------------------------------- connectivity


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


# ------------------------------------------------------------------------------------------------------------------ the atlas


def flipped_faces(obj, sense, triangles, face):
    """Faces that are not positive: their fan is not, and, where they have more than three corners, they are not simple either."""
    uv = obj.corner_uv
    sign = orientation(uv[triangles[:, 0]], uv[triangles[:, 1]], uv[triangles[:, 2]]) * sense[face]
    suspects = np.unique(face[sign <= 0])
    rings = (uv[obj.offsets[f] : obj.offsets[f + 1]][:: sense[f]] for f in suspects)
    return [int(f) for f, ring in zip(suspects, rings, strict=True) if len(ring) == 3 or not polygon_is_simple(ring)]


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
    """The charts' borders as segments, with the questions asked of them."""

    def __init__(self, obj, topology):
        edges = topology.boundary
        with_sense = topology.sense[topology.face[edges]] > 0
        first = np.where(with_sense, edges, topology.next[edges])
        last = np.where(with_sense, topology.next[edges], edges)
        self.start, self.end = topology.node[first], topology.node[last]
        self.a, self.b = obj.corner_uv[first], obj.corner_uv[last]
        self.chart = topology.chart[topology.face[edges]]
        self.size = float(np.abs(obj.corner_uv).max()) + float(np.ptp(obj.corner_uv, axis=0).max())
        leaving = np.full(len(topology.node), -1)
        leaving[self.start] = np.arange(len(edges))
        self.following = leaving[self.end]
        self.loop = components(len(edges), np.arange(len(edges)), self.following)

    def pairs(self, i, j):
        return self.a[i], self.b[i], self.a[j], self.b[j]

    def contacts_and_gap(self, least_reach):
        """Pairs of edges that cross or touch, and the smallest distance between two charts (inf with one)."""
        contacts, gap = set(self._folds()), math.inf
        reach = max(least_reach, float(np.mean(np.linalg.norm(self.b - self.a, axis=1))) / 2)
        for i, j in near_pairs(self.a, self.b, reach):
            distance = segment_distance(*self.pairs(i, j))
            linked = (self.end[i] == self.start[j]) | (self.end[j] == self.start[i])
            for k in np.flatnonzero((distance <= NEAR * self.size) & ~linked):
                one, two = sorted((int(i[k]), int(j[k])))
                if (one, two) not in contacts and exactly_touch(*self.pairs(one, two)):
                    contacts.add((one, two))
            gap = min(gap, self._between(i, j, distance))
        while gap > reach and reach < 4 * self.size and self.chart.max() > 0:
            reach *= 2
            for i, j in near_pairs(self.a, self.b, reach):
                other = self.chart[i] != self.chart[j]
                i, j = i[other], j[other]
                gap = min(gap, self._between(i, j, segment_distance(*self.pairs(i, j))))
        return contacts, gap

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

        The other loops wind 0 times around a point of an outer loop and once around a point of a hole."""
        count = int(self.loop.max()) + 1
        area2 = np.bincount(self.loop, self.a[:, 0] * self.b[:, 1] - self.a[:, 1] * self.b[:, 0], count)
        first = np.unique(self.loop, return_index=True)[1]
        low, high = np.minimum(self.a[:, 1], self.b[:, 1]), np.maximum(self.a[:, 1], self.b[:, 1])
        wrong = []
        for loop in range(count):
            p = self.a[first[loop]]
            hit = np.flatnonzero((low <= p[1]) & (high > p[1]) & (self.loop != loop))
            a, b = self.a[hit], self.b[hit]
            up = np.where(b[:, 1] > a[:, 1], 1, -1)
            right_of_point = orientation(a, b, np.broadcast_to(p, a.shape)) == up
            if int(np.sum(up[right_of_point])) != (0 if area2[loop] > 0 else 1):
                wrong.append(loop)
        return wrong


# ------------------------------------------------------------------------------------------------------------------ the check


def check(in_path, out_path, pe_bound=None, aspect=0.0, gap=None, gap_unit="diagonal", cuts=False):
    """All findings on one pair of files, or on the files of a collection; `problems` is empty where everything holds."""
    started = time.monotonic()
    in_paths, out_paths = ([p] if isinstance(p, str | Path) else p for p in (in_path, out_path))
    found = {"file": Path(in_paths[0]).name, "ok": False, "problems": []}
    pairs = [(read_obj(a), read_obj(b)) for a, b in zip(in_paths, out_paths, strict=True)]
    sources = _check_files(pairs, cuts, found)
    before, after = (one_after_the_other(objs) for objs in zip(*pairs, strict=True))
    problems = found["problems"]
    if problems:
        return found
    found["faces"] = after.faces
    if not np.isfinite(after.corner_uv).all():
        problems.append("UVs: not finite")
        return found
    topology = Topology(after)
    (_check_cut_seams if cuts else _check_seams)(Topology(before), topology, sources, found)

    triangles, face = fan_triangles(after.offsets)
    flipped = flipped_faces(after, topology.sense, triangles, face)
    found.update(triangles=len(triangles), charts=int(topology.chart.max()) + 1, flipped=len(flipped))
    if flipped:
        problems.append(f"flipped or flat: {len(flipped)} faces, first {flipped[0]}")
    box = np.ptp(after.corner_uv, axis=0)
    area = math.fsum(topology.sense * face_areas(after, topology.next))
    _check_efficiency(area, box, pe_bound, aspect, found)
    _check_boundary(Boundary(after, topology), box, gap, gap_unit, found)

    found["e_d_in"] = distortion(before, least_energy_triangles(before))[0]
    found["e_d"], found["stretch_99"], found["stretch_max"] = distortion(after, least_energy_triangles(after))
    found["ok"] = not problems
    found["seconds"] = round(time.monotonic() - started, 3)
    return found


def _check_files(pairs, cuts, found):
    """The face of the inputs that each face of the results is part of."""
    sources, first = [], 0
    for before, after in pairs:
        if before.kept == after.kept:
            own = np.arange(before.faces)
        elif cuts:
            own, problems = divided(before, after)
            found["problems"] += problems
        else:
            own = None
            found["problems"].append("file: records other than UVs differ")
        if own is not None:
            sources.append(own + first)
        first += before.faces
    return np.concatenate(sources) if sources else None


def _check_seams(before, after, _, found):
    split = np.flatnonzero((before.partner >= 0) & (after.partner != before.partner))
    welded = np.flatnonzero((after.partner >= 0) & (after.partner != before.partner))
    found.update(seams_in=before.seams, seams=after.seams, added_seams=len(split) // 2, removed_seams=len(welded) // 2)
    if len(split):
        found["problems"].append(f"seams: {len(split) // 2} added, first at face {int(after.face[split[0]])}")
    if len(welded):
        found["problems"].append(f"seams: {len(welded) // 2} removed, first at face {int(after.face[welded[0]])}")


def _check_cut_seams(before, after, sources, found):
    found.update(seams_in=before.seams, seams=after.seams, bl_in=before.seam_length, bl=after.seam_length)
    joined = joined_anew(before, after, sources)
    if len(joined):
        found["problems"].append(f"seams: {len(joined)} removed, first at face {int(after.face[joined[0]])}")


def _check_efficiency(area, box, pe_bound, aspect, found):
    width, height = float(box[0]), float(box[1])
    wide = max(width, height * aspect) if aspect else width
    found["pe"] = area / (width * height)
    found["pe_fixed_aspect"] = area / (wide * wide / aspect) if aspect else found["pe"]
    if pe_bound is not None and not found["pe_fixed_aspect"] >= pe_bound - 1e-12:
        found["problems"].append(f"PE: {found['pe_fixed_aspect']:.6f} is below {pe_bound}")


def _check_boundary(boundary, box, gap, gap_unit, found):
    unit = float(np.hypot(*box)) if gap_unit == "diagonal" else float(box.max())
    contacts, between = boundary.contacts_and_gap((gap or 0) * unit)
    loops = boundary.overlapping_loops() if not contacts else []
    found.update(contacts=len(contacts), overlapping_loops=len(loops), gap=between / unit)
    if contacts:
        found["problems"].append(f"borders: {len(contacts)} pairs of edges cross or touch")
    if loops:
        found["problems"].append(f"borders: {len(loops)} loops lie inside other charts")
    if gap is not None and not between / unit >= gap * (1 - 1e-9):
        found["problems"].append(f"gap: {between / unit:.9f} is below {gap}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("input")
    parser.add_argument("output")
    parser.add_argument("--pe-bound", type=float)
    parser.add_argument("--aspect", type=float, default=0.0, help="width / height of the box, 0 = free")
    parser.add_argument("--gap", type=float, help="smallest distance between charts that must hold, as fraction of the unit")
    parser.add_argument("--gap-unit", choices=["diagonal", "long_side"], default="diagonal")
    parser.add_argument("--cuts", action="store_true", help="seams may be added and faces divided")
    options = parser.parse_args()
    goal = (options.pe_bound, options.aspect, options.gap, options.gap_unit)
    try:
        found = check(options.input, options.output, *goal, cuts=options.cuts)
    except (OSError, ValueError, IndexError) as error:
        print(f"check_atlas: {options.output}: cannot be read: {error}", file=sys.stderr)
        return 2
    finite = {k: None if isinstance(v, float) and not math.isfinite(v) else v for k, v in found.items()}
    print(json.dumps(finite))
    return 0 if found["ok"] else 1


if __name__ == "__main__":
    sys.exit(main())
