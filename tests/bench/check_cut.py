"""Whether the faces of one file are those of another, divided: without knowledge of what was divided how, and without the library.

Faces come in the order of the faces that they are parts of. Parts tile their face where their vector areas add up to its own (that sum
depends on nothing but the outline, also where a polygon is not flat), every vertex of theirs lies on it, and no edge is open that
was not open before.
"""

import itertools

import numpy as np
from joins import components
from triangles import SLIVER

NEAR = 1e-9  # of the face's size: so near a point lies on it
AREA = 1e-11  # of size times coordinates: what areas may differ by
SIDES_TRIED = 7  # polygons of so many sides are tried with every triangle of their corners


def vector_areas(obj):
    """Newell's vector of each face, taken from its first corner, and the face's perimeter."""
    first = np.repeat(obj.offsets[:-1], np.diff(obj.offsets))
    following = np.arange(len(obj.corner_vertex)) + 1
    following[obj.offsets[1:] - 1] = obj.offsets[:-1]
    p = obj.positions[obj.corner_vertex]
    spokes = p - p[first]
    areas = np.add.reduceat(np.cross(spokes, spokes[following]), obj.offsets[:-1]) / 2
    return areas, np.add.reduceat(np.linalg.norm(p[following] - p, axis=1), obj.offsets[:-1])


def distance_to_segment(p, a, b):
    along = b - a
    length2 = along @ along
    t = min(max((p - a) @ along / length2, 0.0), 1.0) if length2 > 0 else 0.0
    return np.linalg.norm(p - a - t * along)


def distance_to_triangle(p, a, b, c):
    normal = np.cross(b - a, c - a)
    size2 = normal @ normal
    if size2 > 0:
        inside = all(np.cross(y - x, p - x) @ normal >= 0 for x, y in ((a, b), (b, c), (c, a)))
        if inside:
            return abs((p - a) @ normal) / np.sqrt(size2)
    return min(distance_to_segment(p, a, b), distance_to_segment(p, b, c), distance_to_segment(p, c, a))


class Division:
    """Finds the face of `before` that each face of `after` is part of; `problem` says why that cannot be."""

    def __init__(self, before, after):
        self.before, self.after = before, after
        self.old = len(before.positions)
        self.area, self.size = vector_areas(before)
        self.part_area = vector_areas(after)[0]
        self.far = float(np.abs(before.positions).max())
        self.allowed = AREA * (self.far + self.size) * self.size
        self.on = {}
        self.sources = np.full(after.faces, -1)
        self.problem = self.assign()

    def assign(self):
        face, parts, covered = 0, 0, np.zeros(3)
        for part in range(self.after.faces):
            while not self.takes(part, face, covered, parts):
                if problem := self.unfinished(face, parts, covered):
                    return f"{problem}, before part {part}"
                face, parts, covered = face + 1, 0, np.zeros(3)
                if face == self.before.faces:
                    return f"face {part} of the result is part of no face"
            self.sources[part] = face
            parts, covered = parts + 1, covered + self.part_area[part]
        if problem := self.unfinished(face, parts, covered):
            return problem
        return "" if face + 1 == self.before.faces else f"face {face + 1} is lost"

    def unfinished(self, face, parts, covered):
        if not parts:
            return f"face {face} is lost"
        missing = np.linalg.norm(self.area[face] - covered)
        return f"face {face} is not tiled, area {missing:.3g} is missing" if missing > self.allowed[face] else ""

    def takes(self, part, face, covered, parts):
        if not self.lies_on(part, face):
            return False
        tiled = np.linalg.norm(self.area[face] - covered) <= self.allowed[face]
        if not parts or not tiled or face + 1 == self.before.faces or not self.lies_on(part, face + 1):
            return True
        # Of a face without area parts may be missing still: those that follow tell.
        for later in range(part + 1, self.after.faces):
            if not self.lies_on(later, face):
                return False
            if not self.lies_on(later, face + 1):
                return True
        return False

    def lies_on(self, part, face):
        own = self.before.face(face).tolist()
        return all(v in own if v < self.old else self.point_lies_on(v, face) for v in self.after.face(part).tolist())

    def point_lies_on(self, vertex, face):
        if (vertex, face) not in self.on:
            p, corners = self.after.positions[vertex], self.before.positions[self.before.face(face)]
            every = len(corners) <= SIDES_TRIED
            fan = ((0, k, k + 1) for k in range(1, len(corners) - 1))
            triangles = itertools.combinations(range(len(corners)), 3) if every else fan
            self.on[vertex, face] = any(distance_to_triangle(p, *corners[list(t)]) <= self.near(face) for t in triangles)
        return self.on[vertex, face]

    def near(self, face):
        return NEAR * self.size[face] + 1e-14 * self.far


def open_edges(obj, by_index=False):
    """(first corners of the edges that one face only has, the corner after each corner); vertices of equal position are taken for one,
    but not where they count by index."""
    place = np.unique(obj.positions + 0.0, axis=0, return_inverse=True)[1].reshape(-1)[obj.corner_vertex]
    place = obj.corner_vertex if by_index else place
    following = np.arange(len(place)) + 1
    following[obj.offsets[1:] - 1] = obj.offsets[:-1]
    edges = np.sort(np.stack([place, place[following]], axis=1), axis=1)
    first, count = np.unique(edges, axis=0, return_index=True, return_counts=True)[1:]
    return first[count == 1], following


def open_length(obj, by_index=False):
    alone, following = open_edges(obj, by_index)
    p = obj.positions[obj.corner_vertex]
    return float(np.linalg.norm(p[following[alone]] - p[alone], axis=1).sum())


def opened_length(before, after, division):
    """Length of the open edges that lie along no edge of their face that was open before."""
    were_open, sides = {}, open_edges(before)
    p = before.positions[before.corner_vertex]
    face_of = np.repeat(np.arange(before.faces), np.diff(before.offsets))
    for c in sides[0].tolist():
        were_open.setdefault(int(face_of[c]), []).append((p[c], p[sides[1][c]]))
    alone, following = open_edges(after)
    p, source = after.positions[after.corner_vertex], np.repeat(division.sources, np.diff(after.offsets))
    opened = 0.0
    for c in alone.tolist():
        ends, face = (p[c], p[following[c]]), int(source[c])
        near = division.near(face)
        along = any(all(distance_to_segment(end, *edge) <= near for end in ends) for edge in were_open.get(face, ()))
        opened += 0.0 if along else float(np.linalg.norm(ends[1] - ends[0]))
    return opened


def kept_normals(before, after, sources):
    """Whether old corners keep their normals, and new ones have one where their face has normals."""
    faces = np.repeat(np.arange(before.faces), np.diff(before.offsets)).tolist()
    table = dict(zip(zip(faces, before.corner_vertex.tolist(), strict=True), before.corner_normal.tolist(), strict=True))
    face_has = before.corner_normal[before.offsets[:-1]] >= 0
    owner = np.repeat(sources, np.diff(after.offsets)).tolist()
    for source, vertex, normal in zip(owner, after.corner_vertex.tolist(), after.corner_normal.tolist(), strict=True):
        expected = table.get((source, vertex))
        if (normal >= 0) != face_has[source] or (expected is not None and normal != expected):
            return False
    return True


def divided(before, after):
    """(source of each face of `after`, problems)."""
    problems = []
    if after.vertex_records[: len(before.vertex_records)] != before.vertex_records:
        problems.append("file: the positions of the input do not come first and unchanged")
    if after.normal_records[: len(before.normal_records)] != before.normal_records:
        problems.append("file: the normals of the input do not come first and unchanged")
    if after.other_records != before.other_records:
        problems.append("file: records other than positions, UVs, normals and faces differ")
    if problems:
        return None, problems
    division = Division(before, after)
    if division.problem:
        return None, [f"surface: {division.problem}"]
    sources = division.sources
    if not np.array_equal(after.others_before_face, before.others_before_face[sources]):
        problems.append("file: a part of a face stands in another group, material or smoothing group")
    if not kept_normals(before, after, sources):
        problems.append("file: normals of corners differ")
    opened = opened_length(before, after, division)
    if opened > NEAR * float(division.size.sum()):
        problems.append(f"surface: edges of length {opened:.3g} are open that were not")
    # Faces that share an edge share its new vertices too, or it is open for whoever reads the file.
    doubled = open_length(after, by_index=True) - open_length(before, by_index=True)
    if doubled > NEAR * float(division.size.sum()):
        problems.append(f"surface: edges of length {doubled:.3g} have doubled vertices where the input has one")
    return sources, problems


def joined_across(f, g, without_area):
    """Pairs of faces that such faces lie between, of pairs that are joined: these are joined there as well."""
    label = components(len(without_area), *(x[without_area[f] & without_area[g]] for x in (f, g)))
    around = {}
    for a, b in zip(np.r_[f, g].tolist(), np.r_[g, f].tolist(), strict=True):
        if without_area[a]:
            around.setdefault(int(label[a]), set()).update((a, b))
    pairs = [pair for near in around.values() for pair in itertools.combinations(sorted(near), 2)]
    return np.array(pairs, dtype=int).reshape(-1, 2).T


def collapsed_alike(source, before):
    """Pairs of faces whose sides of one edge are the same point in the UVs, but for noise: no seam can be told there."""
    uv, noise = source.corner_uv, before.noise_of(source)
    point = (before.partner < 0) & (np.linalg.norm(uv[before.next] - uv, axis=1) <= noise)
    at_edge = {}
    for h in np.flatnonzero(point).tolist():
        at_edge.setdefault(tuple(sorted((int(before.place[h]), int(before.place[before.next[h]])))), []).append(h)
    pairs = [pair for sides in at_edge.values() for pair in itertools.combinations(sides, 2)]
    near = [before.face[[a, b]] for a, b in pairs if np.linalg.norm(uv[a] - uv[b]) <= noise]
    return np.array(near, dtype=int).reshape(-1, 2).T


def joined_anew(source, before, after, sources):
    """Faces of the result joined in UV space though the faces that they are parts of are not: pairs of half-edges."""
    one = np.flatnonzero(before.partner > np.arange(len(before.partner)))
    faces = int(before.face.max()) + 1
    f, g = before.face[one], before.face[before.partner[one]]
    area, size = vector_areas(source)
    across = joined_across(f, g, np.linalg.norm(area, axis=1) <= SLIVER * size**2)
    points = collapsed_alike(source, before)
    f, g = np.r_[f, across[0], points[0]], np.r_[g, across[1], points[1]]
    joined = np.unique(np.minimum(f, g) * faces + np.maximum(f, g))
    one = np.flatnonzero(after.partner > np.arange(len(after.partner)))
    f, g = sources[after.face[one]], sources[after.face[after.partner[one]]]
    return one[(f != g) & ~np.isin(np.minimum(f, g) * faces + np.maximum(f, g), joined)]


def torn_anew(source, before, result, after, sources):
    """How many edges in space of the result are torn where the input was whole, between parts of one face and along joined edges;
    an edge along which charts were folded counts once, however it has been divided.

    A part of an input edge is known by its faces, which are parts of two faces that were joined, and by where it lies: not along an
    edge that was open before."""
    faces = int(before.face.max()) + 1
    one = np.flatnonzero(before.partner >= 0)
    whole = set((before.face[one] * faces + before.face[before.partner[one]]).tolist())
    seams = {}
    for h in np.flatnonzero(before.partner < 0).tolist():
        seams.setdefault(int(before.face[h]), []).append(source.positions[source.corner_vertex[[h, before.next[h]]]])
    edges = np.sort(np.stack([after.place, after.place[after.next]], axis=1), axis=1)
    at_edge = {}
    for h in np.flatnonzero((after.partner < 0) & (edges[:, 0] != edges[:, 1])).tolist():
        f, ends = int(sources[after.face[h]]), result.positions[result.corner_vertex[[h, after.next[h]]]]
        if not any(all(distance_to_segment(p, a, b) <= NEAR * np.linalg.norm(b - a) for p in ends) for a, b in seams.get(f, ())):
            at_edge.setdefault(tuple(edges[h].tolist()), []).append(f)
    folded = set((before.face[before.fold] * faces + before.face[before.partner[before.fold]]).tolist())
    torn, parted = 0, set()
    for parts_of in at_edge.values():
        while parts_of:
            f = parts_of.pop()
            other = next((g for g in parts_of if f == g or f * faces + g in whole), None)
            if other is None:
                continue
            parts_of.remove(other)
            if f * faces + other in folded:
                parted.add((min(f, other), max(f, other)))
            else:
                torn += 1
    return torn + len(parted)
