"""OBJ files as the checks need them: arrays for geometry, and the records that must not change."""

import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np


@dataclass
class Obj:
    kept: list  # every record but vt, faces without their vt indices
    positions: np.ndarray
    corner_vertex: np.ndarray
    corner_uv: np.ndarray
    corner_normal: np.ndarray  # -1 where there is none
    offsets: np.ndarray
    vertex_records: list  # v and vn records as they are written
    normal_records: list
    other_records: list  # neither data nor faces; elements with absolute indices
    others_before_face: np.ndarray  # how many of them stand before each face

    @property
    def faces(self):
        return len(self.offsets) - 1

    def face(self, k):
        """Vertices of face k."""
        return self.corner_vertex[self.offsets[k] : self.offsets[k + 1]]


DATA = (b"v", b"vt", b"vn", b"f", b"l", b"p")


def absolute(index, count):
    """From 0; below 0 where it is none."""
    return index - 1 if index > 0 else count + index if index < 0 else -1


def number(text):
    """Also what C's printf writes for what is no number."""
    try:
        return float(text)
    except ValueError:
        return math.nan


def numbers(tokens):
    """Up to a comment."""
    end = next((k for k, token in enumerate(tokens) if token[:1] == b"#"), len(tokens))
    return [number(token) for token in tokens[1:end]]


def logical_lines(text):
    """Data records that a backslash continues as one line."""
    joined = b""
    for line in text.removeprefix(b"\xef\xbb\xbf").splitlines():
        start = joined or line
        continued = line.rstrip(b" \t\v\f").endswith(b"\\") and start.split()[:1] in [[keyword] for keyword in DATA]
        joined += line.rstrip(b" \t\v\f")[:-1] + b" " if continued else line
        if not continued:
            yield joined
            joined = b""
    if joined:
        yield joined


def is_outline(vertices):
    """Whether a polygon is one loop of three different vertices or more, or several that it joins by edges walked to and fro."""
    if len(set(vertices)) == len(vertices):
        return len(vertices) >= 3
    loops, seen = [vertices], []
    while loops:
        loop = loops.pop()
        edges = list(zip(loop, loop[1:] + loop[:1], strict=True))
        back = [(k, edges.index((b, a))) for k, (a, b) in enumerate(edges) if (b, a) in edges]
        if back:
            (k, other) = min(back)
            loops += [loop[k + 1 : other], loop[other + 1 :] + loop[:k]]
        elif len(loop) < 3:
            return False
        else:
            seen += loop
    return len(set(seen)) == len(seen)


def finite_records(lines, keyword, count):
    """One flag for each such record: whether its first numbers are finite."""
    records = (line.split() for line in lines)
    return [all(map(math.isfinite, numbers(tokens)[:count])) for tokens in records if tokens[:1] == [keyword]]


class Reader:
    def __init__(self, lines):
        self.finite = finite_records(lines, b"v", 3), finite_records(lines, b"vt", 2)
        self.kept, self.positions, self.uvs = [], [], []
        self.vertices, self.normals, self.others, self.others_before = [], [], [], []
        self.corner_vertex, self.corner_uv, self.corner_normal, self.offsets = [], [], [], [0]

    def read(self, line):
        tokens = line.split()
        keyword = tokens[0] if tokens else b""
        if keyword == b"vt":
            self.uvs.append((*numbers(tokens), 0.0)[:2])
        elif keyword in (b"f", b"l"):
            end = next((k for k, token in enumerate(tokens) if token[:1] == b"#"), len(tokens))
            corners = [token.split(b"/") for token in tokens[1:end]]
            self.kept.append((keyword, [(c[0], *c[2:]) for c in corners]))
            if keyword == b"l" or not self.face(corners):
                vertices = [absolute(int(c[0]), len(self.positions)) for c in corners]
                self.others.append((keyword, vertices, [self.uv_index(corner) for corner in corners]))
        else:
            self.kept.append(line)
            self.unindexed(keyword, tokens, line)

    def unindexed(self, keyword, tokens, line):
        if keyword == b"v":
            found = numbers(tokens)
            w = found[3] if len(found) == 4 and found[3] != 0 else 1.0
            self.positions.append([x / w for x in found[:3]])
            self.vertices.append(line)
        elif keyword == b"vn":
            self.normals.append(line)
        elif keyword == b"p":
            self.others.append((keyword, [absolute(int(t), len(self.positions)) for t in tokens[1:]]))
        elif tokens:
            self.others.append(line)

    def uv_index(self, corner):
        return absolute(int(corner[1]), len(self.uvs)) if len(corner) > 1 and corner[1] else -1

    def are_there(self, vertices, uvs):
        """Whether the file has all of these, and all are finite."""
        named = zip(self.finite, (vertices, uvs), strict=True)
        return all(0 <= index < len(finite) and finite[index] for finite, indices in named for index in indices)

    def face(self, corners):
        """Whether the face is in the atlas: vertices named in a row count once, each comes once but for bridges of keyholes, and all
        corners have UVs, finite as positions are."""
        vertices = [absolute(int(corner[0]), len(self.positions)) for corner in corners]
        own = [k for k, v in enumerate(vertices) if k == 0 or v != vertices[k - 1]]
        while len(own) > 1 and vertices[own[-1]] == vertices[own[0]]:
            own.pop()
        uvs = [self.uv_index(corner) for corner in corners]
        if not is_outline([vertices[k] for k in own]) or not self.are_there(vertices, uvs):
            return False
        self.others_before.append(len(self.others))
        for k in own:
            self.corner_vertex.append(vertices[k])
            self.corner_uv.append(uvs[k])
            normal = corners[k][2] if len(corners[k]) > 2 else b""
            self.corner_normal.append(absolute(int(normal), len(self.normals)) if normal else -1)
        self.offsets.append(len(self.corner_vertex))
        return True

    def elements(self):
        """Of lines and of faces that are not in the atlas the UVs instead of their numbers, as text: what is no number too.

        Records that faces of the atlas have as well move with those."""
        shared = set(self.corner_uv)
        for record in self.others:
            if isinstance(record, tuple) and len(record) == 3:
                keyword, vertices, uvs = record
                own = [0 <= uv < len(self.uvs) and uv not in shared for uv in uvs]
                vertices = [v if 0 <= v < len(self.positions) else "none" for v in vertices]
                yield keyword, vertices, [repr(self.uvs[uv]) if kept else "" for uv, kept in zip(uvs, own, strict=True)]
            else:
                yield record


def read_obj(path):
    lines = list(logical_lines(Path(path).read_bytes()))
    reader = Reader(lines)
    for line in lines:
        reader.read(line)
    uv_table = np.array(reader.uvs, dtype=float).reshape(-1, 2)
    others = list(reader.elements())
    return Obj(
        [*reader.kept, *(record for record in others if isinstance(record, tuple))],
        np.array(reader.positions),
        np.array(reader.corner_vertex, dtype=int),
        uv_table[np.array(reader.corner_uv, dtype=int)] + 0.0,
        np.array(reader.corner_normal, dtype=int),
        np.array(reader.offsets),
        reader.vertices,
        reader.normals,
        others,
        np.array(reader.others_before),
    )


def one_after_the_other(objs):
    """Several files as one: geometry only."""
    if len(objs) == 1:
        return objs[0]
    vertices = np.cumsum([0] + [len(obj.positions) for obj in objs])
    corners = np.cumsum([0] + [len(obj.corner_vertex) for obj in objs])
    return Obj(
        [],
        np.concatenate([obj.positions for obj in objs]),
        np.concatenate([obj.corner_vertex + first for obj, first in zip(objs, vertices, strict=False)]),
        np.concatenate([obj.corner_uv for obj in objs]),
        np.concatenate([obj.corner_normal for obj in objs]),
        np.concatenate([[0], *(obj.offsets[1:] + first for obj, first in zip(objs, corners, strict=False))]),
        [],
        [],
        [],
        np.array([]),
    )
