"""The checker on results that cut: it accepts faces divided rightly and finds each way of dividing them wrongly."""

import check_atlas
import check_cut
import numpy as np
import obj_text
import pytest
from topology import Topology

# Two triangles that share the edge 1-3, each in a half of the unit square, and a quad that is not flat; the quad's UVs lie apart.
BEFORE = """mtllib a.mtl
v 0 0 0 1 0 0
v 1 0 0 0 1 0
v 1 1 0 0 0 1
v 0 1 0 0 0 0
v 2 0 0.5
v 2 1 0
vt 0 0
vt 0.5 0
vt 0.5 0.5
vt 0 0.5
vt 0.6 0
vt 1 0
vt 1 0.5
vt 0.6 0.5
vn 0 0 1
vn 1 0 0
g one
f 1/1/1 2/2/1 3/3/2
f 1/1/1 3/3/2 4/4/1
g two
usemtl other
f 2/5 5/6 6/7 3/8
"""

# The diagonal gets a vertex at its middle, and the first triangle is cut from there to vertex 2; the second half moves away. The
# second triangle, which gained a corner, is divided there.
BESIDE = "f 1/1/1 7/9/3 4/4/1\nf 7/9/3 3/3/2 4/4/1"
FACES = BEFORE[BEFORE.index("g one") :]
AFTER = (
    BEFORE.replace("vt 0 0\n", "v 0.5 0.5 0 0.5 0 0.5\nvt 0 0\n")
    .replace("vn 0 0 1", "vt 0.25 0.25\nvt 0.5 -0.5\nvt 0.5 0\nvt 0.25 -0.25\nvn 0 0 1")
    .replace("g one", "vn 0.7 0 0.7\ng one")
    .replace("f 1/1/1 2/2/1 3/3/2", "f 1/1/1 2/2/1 7/9/3\nf 2/10/1 3/11/2 7/12/3")
    .replace("f 1/1/1 3/3/2 4/4/1", BESIDE)
)


def check(tmp_path, after, before=BEFORE, cuts=True, **options):
    (tmp_path / "in.obj").write_text(before)
    (tmp_path / "out.obj").write_text(after)
    return check_atlas.check(tmp_path / "in.obj", tmp_path / "out.obj", cuts=cuts, **options)


def problems(tmp_path, after, before=BEFORE, **options):
    return " | ".join(check(tmp_path, after, before, **options)["problems"])


# Apart from each other, as a result has to be.
APART = AFTER.replace("vt 0.5 -0.5", "vt 0.5 -0.6").replace("vt 0.5 0\nvt 0.25 -0.25", "vt 0.5 -0.1\nvt 0.25 -0.35")


def test_good_cut(tmp_path):
    found = check(tmp_path, APART)
    assert found["problems"] == []
    assert (found["charts"], found["flipped"], found["contacts"]) == (3, 0, 0)
    assert found["faces"] == 5


def test_corner_in_the_middle_of_a_side(tmp_path):
    """As one face the divided triangle is simple, but its fan from vertex 1 is flat."""
    found = problems(tmp_path, APART.replace(BESIDE, "f 1/1/1 7/9/3 3/3/2 4/4/1"))
    assert found == " | ".join(f"{way}: 1 faces are flipped where divided so, first 2" for way in ("fan", "diagonals"))


def test_torn_edges_are_counted(tmp_path):
    """The cut from vertex 2 to the middle of the diagonal, and half of the diagonal."""
    assert check(tmp_path, APART)["added_seams"] == 2
    assert check(tmp_path, BEFORE)["added_seams"] == 0


def test_lengths_of_seams(tmp_path):
    """Before: the edge between the square and the quad. After: the cut and the half diagonal as well."""
    found = check(tmp_path, APART)
    diagonal = (4 + 1 + 0.25) ** 0.5
    assert found["bl_in"] == pytest.approx(1 / diagonal)
    assert found["bl"] == pytest.approx((1 + 2 * 0.5**0.5) / diagonal)


def test_cut_is_refused_where_none_is_allowed(tmp_path):
    assert "records other than UVs differ" in problems(tmp_path, APART, cuts=False)


def test_contact_after_a_cut(tmp_path):
    assert "borders" in problems(tmp_path, AFTER.replace("vt 0.5 -0.5", "vt 0.5 0.4"))


def test_moved_input_vertex(tmp_path):
    assert "positions of the input" in problems(tmp_path, APART.replace("v 2 1 0", "v 2 1 1e-9"))
    assert "positions of the input" in problems(tmp_path, APART.replace("v 0 0 0 1 0 0", "v 0 0 0 1 0 0.1"))


@pytest.mark.parametrize("moved", ["v 0.5 0.5 1e-6", "v 0.5 0.51 0", "v 0.6 0.61 0"])
def test_new_vertex_off_the_surface(tmp_path, moved):
    assert "surface" in problems(tmp_path, APART.replace("v 0.5 0.5 0", moved))


def test_lost_part(tmp_path):
    assert "face 0 is not tiled" in problems(tmp_path, APART.replace("f 2/10/1 3/11/2 7/12/3\n", ""))
    assert "face 1 is lost" in problems(tmp_path, APART.replace(BESIDE + "\n", ""))
    assert "face 2 is lost" in problems(tmp_path, APART.replace("f 2/5 5/6 6/7 3/8\n", ""))


def test_part_that_is_there_twice(tmp_path):
    part = "f 2/10/1 3/11/2 7/12/3\n"
    assert "surface" in problems(tmp_path, APART.replace(part, part + part))


def test_part_that_is_turned_over(tmp_path):
    turned = APART.replace("f 2/10/1 3/11/2 7/12/3", "f 7/12/3 3/11/2 2/10/1")
    assert "face 0 is not tiled" in problems(tmp_path, turned)


def test_edge_divided_on_one_side_only(tmp_path):
    one_sided = APART.replace(BESIDE, "f 1/1/1 3/3/2 4/4/1")
    assert "edges of length 2.83 are open" in problems(tmp_path, one_sided)


def test_long_edge_divided_where_shorter_ones_meet_that_lie_along_it(tmp_path):
    before = "v 0 0 0\nv 2 0 0\nv 1 1 0\nv 1 0 0\nv 0.5 -1 0\nv 1.5 -1 0\n"
    before += "vt 0 0\nvt 0.2 0\nvt 0.1 0.1\nvt 0.5 0.5\nvt 0.55 0.4\nvt 0.6 0.5\nvt 0.75 0.4\nvt 0.8 0.5\nvt 0.7 0.5\n"
    after = before + "v 1 0 0\nvt 0.1 0\nf 1/1 7/10 3/3\nf 7/10 2/2 3/3\n"
    below = "f 1/4 5/5 4/6\nf 4/9 6/7 2/8\n"
    assert problems(tmp_path, after + below, before + "f 1/1 2/2 3/3\n" + below) == ""


def test_what_closes_elsewhere_hides_no_crack(tmp_path):
    """Beside such an edge, which closes, two squares whose common edge is divided in one of them only."""
    before = "v 0 0 0\nv 2 0 0\nv 1 1 0\nv 1 0 0\nv 0.5 -1 0\nv 1.5 -1 0\nv 5 0 0\nv 6 0 0\nv 6 1 0\nv 5 1 0\nv 7 0 0\nv 7 1 0\n"
    before += "vt 0 0\nvt 0.2 0\nvt 0.1 0.1\nvt 0.5 0.5\nvt 0.55 0.4\nvt 0.6 0.5\nvt 0.75 0.4\nvt 0.8 0.5\nvt 0.7 0.5\n"
    before += "vt 0 0.8\nvt 0.1 0.8\nvt 0.1 0.9\nvt 0 0.9\nvt 0.3 0.8\nvt 0.4 0.8\nvt 0.4 0.9\nvt 0.3 0.9\n"
    below = "f 1/4 5/5 4/6\nf 4/9 6/7 2/8\n"
    right = "f 8/14 11/15 12/16 9/17\n"
    whole = before + "f 1/1 2/2 3/3\n" + below + "f 7/10 8/11 9/12 10/13\n" + right
    cracked = before + "v 1 0 0\nvt 0.1 0\nv 6 0.5 0\nvt 0.1 0.85\nf 1/1 13/18 3/3\nf 13/18 2/2 3/3\n" + below
    cracked += "f 7/10 8/11 14/19 10/13\nf 14/19 9/12 10/13\n" + right
    assert "edges of length 2 are open" in problems(tmp_path, cracked, whole)


def test_part_in_another_group(tmp_path):
    moved = APART.replace("g two\nusemtl other\n", "").replace("f 1/1/1 7/9", "g two\nusemtl other\nf 1/1/1 7/9")
    assert "another group" in problems(tmp_path, moved)
    assert "records other than" in problems(tmp_path, APART.replace("usemtl other\n", ""))


def test_normals(tmp_path):
    assert "normals of corners" in problems(tmp_path, APART.replace("f 2/10/1 3/11/2", "f 2/10/2 3/11/2"))
    assert "normals of corners" in problems(tmp_path, APART.replace("f 2/5 5/6 6/7 3/8", "f 2/5/1 5/6/1 6/7/1 3/8/1"))
    assert "normals of the input" in problems(tmp_path, APART.replace("vn 1 0 0", "vn 1 0 0.1"))


def test_seam_that_is_closed(tmp_path):
    """The quad's side 2-3 gets the UVs that the triangle has there."""
    closed = AFTER.replace("f 2/5 5/6 6/7 3/8", "f 2/10 5/6 6/7 3/11").replace("vt 0.6 0\n", "vt 0.6 0.6\n")
    assert "seams: 1 removed" in problems(tmp_path, closed)


def test_polygon_that_is_not_flat_may_be_divided(tmp_path):
    """Across a diagonal, with a new vertex on one of its halves."""
    inside = APART.replace("vt 0 0\n", "v 1.5 0.5 0.25\nvt 0 0\n").replace("vn 0 0 1", "vt 0.8 0.25\nvn 0 0 1")
    parts = "\n".join(f"f {a} {b} 8/13" for a, b in (("2/5", "5/6"), ("5/6", "6/7"), ("6/7", "3/8"), ("3/8", "2/5")))
    assert problems(tmp_path, inside.replace("f 2/5 5/6 6/7 3/8", parts)) == ""


def test_identical_faces_are_told_apart(tmp_path):
    """A face that is there twice, front and front: each has parts of its own."""
    before = BEFORE.replace("g two", "f 1/1/1 3/3/2 4/4/1\ng two")
    after = APART.replace("g two", f"{BESIDE}\ng two")
    found = problems(tmp_path, after, before)
    assert "surface" not in found
    assert "file" not in found


def test_collection(tmp_path):
    """Two models in one atlas: beside each other they are good, one above the other they are not."""
    lines = APART.splitlines()
    beside = [f"vt {float(line.split()[1]) + 2} {line.split()[2]}" if line.startswith("vt ") else line for line in lines]
    for name, text in (("in", BEFORE), ("a", APART), ("b", "\n".join(beside) + "\n")):
        (tmp_path / f"{name}.obj").write_text(text)

    def run(*outputs):
        return check_atlas.check([tmp_path / "in.obj"] * 2, [tmp_path / f"{name}.obj" for name in outputs], cuts=True)

    good = run("a", "b")
    assert (good["problems"], good["charts"], good["faces"]) == ([], 6, 10)
    assert "borders" in " ".join(run("a", "a")["problems"])


def test_a_vertex_that_two_faces_have_twice(tmp_path):
    """Both faces at the diagonal have its new vertex at one place, but not the same one."""
    twice = APART.replace("vt 0 0\n", "v 0.5 0.5 0 0.5 0 0.5\nvt 0 0\n", 1).replace(BESIDE, BESIDE.replace("7/9/3", "8/9/3"))
    assert problems(tmp_path, twice) == "surface: edges of length 2.83 have doubled vertices where the input has one"
    apart = BEFORE.replace("v 2 0 0.5", "v 1 1 0\nv 0 0 0\nv 2 0 0.5").replace("f 2/5 5/6 6/7 3/8", "f 2/5 7/6 8/7 3/8")
    unwelded = apart.replace("f 1/1/1 3/3/2 4/4/1", "f 6/1/1 5/3/2 4/4/1")
    assert check_cut.open_length(read(tmp_path, unwelded), by_index=True) > check_cut.open_length(
        read(tmp_path, apart), by_index=True
    )


def read(tmp_path, text):
    (tmp_path / "read.obj").write_text(text)
    return obj_text.read_obj(tmp_path / "read.obj")


# A triangle, one without area in space on the edge that it shares with a third.
FLAT_BETWEEN = "v 0 0 0\nv 2 0 0\nv 1 1 0\nv 1 0 0\nv 1 -1 0\nvt 0 0\nvt 1 0\nvt .5 .5\nvt .5 -.1\nvt .5 -.6\n"
ACROSS = "f 1/1 2/2 3/3\nf 1/1 4/4 2/2\nf 1/1 5/5 4/4\nf 4/4 5/5 2/2\n"


def test_faces_without_area_are_not_lost(tmp_path):
    """The middle one lies on its neighbour as a whole: each face has a part of its own all the same."""
    before = FLAT_BETWEEN + "f 1/1 4/4 2/2\nf 1/1 2/2 3/3\n"
    after = before.replace("f 1/1 4/4 2/2", "f 1/1 6/6 2/2\nf 6/6 4/4 2/2").replace("vt 0 0", "v 0.5 0 0\nvt 0 0")
    assert list(check_cut.Division(read(tmp_path, before), read(tmp_path, before)).sources) == [0, 1]
    found = check_cut.Division(read(tmp_path, before), read(tmp_path, after.replace("6/6", "6/5")))
    assert (found.problem, list(found.sources)) == ("", [0, 0, 1])


def test_faces_joined_across_one_without_area_may_be_joined(tmp_path):
    obj = read(tmp_path, FLAT_BETWEEN + ACROSS)
    topology = Topology(obj, as_meant=True)
    f, g = topology.face, topology.face[topology.partner]
    joined = topology.partner >= 0
    pairs = check_cut.joined_across(f[joined], g[joined], np.array([False, True, False, False]))
    assert {tuple(pair) for pair in pairs.T.tolist()} == {(a, b) for a in range(4) for b in range(a + 1, 4)}
    none = check_cut.joined_across(f[joined], g[joined], np.zeros(4, dtype=bool))
    assert none.shape == (2, 0)


def test_sides_that_are_one_point_in_the_uvs_have_no_seam(tmp_path):
    """The edge 1-2 is a point at both of its faces, which differ by noise; farther apart it is a seam."""
    text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 -1 0\nvt 0 0\nvt 1 1\nvt {u} 0\nvt 1 -1\nf 1/1 2/1 3/2\nf 2/3 1/3 4/4\n"
    for u, pairs in ((1e-8, [[0, 1]]), (0.01, [])):
        obj = read(tmp_path, text.format(u=u))
        assert check_cut.collapsed_alike(obj, Topology(obj, as_meant=True)).T.tolist() == pairs


@pytest.mark.parametrize("bad", ["1/1 2/2 -9/3", "1/1 2/2 0/3", "1/1 2/2 9/3", "1/1 2/2 3/99", "1/1 7/2 3/3"])
def test_faces_that_name_what_is_not_there_are_not_in_the_atlas(tmp_path, bad):
    obj = read(tmp_path, BEFORE + f"f {bad}\nv nan 0 0\n")
    assert obj.faces == 3
    assert len(obj.other_records) == len(read(tmp_path, BEFORE).other_records) + 1
