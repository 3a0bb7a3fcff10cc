"""OBJ files as the checks need them: arrays for geometry, and the records that must not change."""

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


def absolute(index, count):
    return index - 1 if index > 0 else count + index


class Reader:
    def __init__(self):
        self.kept, self.positions, self.uvs = [], [], []
        self.vertices, self.normals, self.others, self.others_before = [], [], [], []
        self.corner_vertex, self.corner_uv, self.corner_normal, self.offsets = [], [], [], [0]

    def read(self, line):
        tokens = line.split()
        keyword = tokens[0] if tokens else b""
        if keyword == b"vt":
            has_v = len(tokens) > 2 and tokens[2][:1] != b"#"
            self.uvs.append((float(tokens[1]), float(tokens[2]) if has_v else 0.0))
        elif keyword in (b"f", b"l"):
            corners = [t.split(b"/") for t in tokens[1:]]
            self.kept.append((keyword, [(c[0], *c[2:]) for c in corners]))
            if keyword == b"f":
                self.face(corners)
            else:
                self.others.append((keyword, [absolute(int(c[0]), len(self.positions)) for c in corners if c[0][:1] != b"#"]))
        else:
            self.kept.append(line)
            self.unindexed(keyword, tokens, line)

    def unindexed(self, keyword, tokens, line):
        if keyword == b"v":
            self.positions.append([float(t) for t in tokens[1:4]])
            self.vertices.append(line)
        elif keyword == b"vn":
            self.normals.append(line)
        elif keyword == b"p":
            self.others.append((keyword, [absolute(int(t), len(self.positions)) for t in tokens[1:]]))
        elif tokens:
            self.others.append(line)

    def face(self, corners):
        self.others_before.append(len(self.others))
        for corner in corners:
            if corner[0][:1] == b"#":
                break
            self.corner_vertex.append(absolute(int(corner[0]), len(self.positions)))
            self.corner_uv.append(absolute(int(corner[1]), len(self.uvs)))
            self.corner_normal.append(absolute(int(corner[2]), len(self.normals)) if len(corner) > 2 else -1)
        self.offsets.append(len(self.corner_vertex))


def read_obj(path):
    reader = Reader()
    joined = Path(path).read_bytes().replace(b"\\\r\n", b" ").replace(b"\\\n", b" ")
    for line in joined.splitlines():
        reader.read(line)
    uv_table = np.array(reader.uvs, dtype=float).reshape(-1, 2)
    return Obj(
        reader.kept,
        np.array(reader.positions),
        np.array(reader.corner_vertex),
        uv_table[np.array(reader.corner_uv)] + 0.0,
        np.array(reader.corner_normal),
        np.array(reader.offsets),
        reader.vertices,
        reader.normals,
        reader.others,
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
