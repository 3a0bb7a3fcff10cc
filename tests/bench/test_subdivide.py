"""Meshes made finer: the same surface and the same UVs in more triangles, with the same seams."""

import numpy as np
from obj_text import read_obj
from subdivide import halved, subdivided
from topology import Topology
from triangles import distortion, elements

# Two charts: the quad's right half lies apart in the UVs.
SHEET = """v 0 0 0\nv 1 0 0\nv 2 0 1\nv 0 1 0\nv 1 1 0\nv 2 1 1
vt 0 0\nvt 1 0\nvt 0 1\nvt 1 1\nvt 2 0\nvt 3 0\nvt 2 1\nvt 3 1
f 1/1 2/2 5/4 4/3\nf 2/5 3/6 6/8 5/7\n"""


def test_each_triangle_becomes_four_and_edges_share_their_midpoints():
    values, triangles = halved(np.array([[0.0, 0], [2, 0], [0, 2], [2, 2]]), np.array([[0, 1, 2], [1, 3, 2]]))
    assert len(values) == 4 + 5
    assert len(triangles) == 8
    a, b, c = values[triangles].swapaxes(0, 1)
    edges = np.stack([b - a, c - a], axis=1)
    assert np.allclose(np.linalg.det(edges), 1)  # a quarter of 4, and wound as before


def test_a_finer_file_is_the_same_atlas(tmp_path):
    path = tmp_path / "sheet.obj"
    path.write_text(SHEET)
    coarse, finer = read_obj(path), read_obj(subdivided(path, 2, tmp_path / "finer"))
    assert finer.faces == 4 * 16
    assert Topology(finer).seams == 4 * Topology(coarse).seams
    assert np.isclose(distortion(finer, *elements(finer))[0], distortion(coarse, *elements(coarse))[0])
    before = subdivided(path, 2, tmp_path / "finer").stat().st_mtime_ns
    assert subdivided(path, 2, tmp_path / "finer").stat().st_mtime_ns == before
