"""Options that say what charts, faces and edges may become, as the program reads them."""

import json

import pytest
from obj_shapes import arc, grid, records, uvs


def run(program, tmp_path, text, *options, name="in.obj"):
    """(the output, the report)"""
    source, target, report = (tmp_path / each for each in (name, "out.obj", "report.json"))
    source.write_text(text)
    done = program(source, "-o", target, "--report", report, *options)
    assert done.returncode == 0, done.stderr.decode()
    return target.read_text(), json.loads(report.read_text())


def two_of(text, second="", shift=0):
    """The same sheet twice, the second with its UVs moved along u and with lines of its own before its faces."""
    head = [line for line in text.splitlines() if line.split()[0] in ("v", "vt")]
    faces = records(text, "f")
    count = len(head) // 2
    moved = [f"vt {float(line.split()[1]) + shift} {line.split()[2]}" if line.startswith("vt") else line for line in head]

    def after(face):
        return "f " + " ".join("/".join(str(int(k) + count) for k in corner.split("/")) for corner in face.split()[1:])

    return "\n".join(["o first", "usemtl bark", *head, *faces, "o second", second, *moved, *map(after, faces), ""])


# A tetrahedron with one UV for each vertex: its four faces are joined in the UVs as in space, without a border.
CLOSED = (
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvt 0 0\nvt 1 0\nvt 0 1\nvt 0.3 0.3\n"
    "f 1/1 3/3 2/2\nf 1/1 2/2 4/4\nf 2/2 3/3 4/4\nf 3/3 1/1 4/4\n"
)


@pytest.mark.parametrize(
    ("by", "names"),
    [
        ("none", []),
        ("material", ["material bark", "material leaf"]),
        ("object", ["object first", "object second"]),
        ("tile", ["1001", "1002"]),
    ],
)
def test_group_by(program, tmp_path, by, names):
    text = two_of(grid(4, 30), second="usemtl leaf", shift=1.0)
    result, told = run(program, tmp_path, text, "--group-by", by)
    assert [group["name"] for group in told.get("groups", [])] == names
    assert all(group["after"]["pe"] >= 0.8 for group in told.get("groups", []))
    largest = max(u for u, _ in uvs(result))
    assert (1 < largest <= 2) == (by == "tile")


def test_open_closed(program, tmp_path):
    source = tmp_path / "in.obj"
    source.write_text(CLOSED)
    _, told = run(program, tmp_path, CLOSED, "--open-closed", "--pe-bound", "0.4")
    assert told["new_seams"]
    message = program.refused(3, source, "-o", tmp_path / "other.obj", "--pe-bound", "0.4")
    assert "has no boundary" in message
    assert "--open-closed" in message


@pytest.mark.parametrize("stacks", ["keep", "separate"])
def test_stacks(program, tmp_path, stacks):
    result, told = run(program, tmp_path, two_of(grid(4, 30)), "--stacks", stacks)
    points = uvs(result)
    half = len(points) // 2
    assert (points[:half] == points[half:]) == (stacks == "keep")
    first, second = told["charts"]
    assert second["fate"] == ("stacked" if stacks == "keep" else "refined")
    assert second["face_ranges"] == ([[first["faces"], 2 * first["faces"] - 1]] if stacks == "keep" else None)


@pytest.mark.parametrize("collapsed", ["leave", "embed"])
def test_collapsed(program, tmp_path, collapsed):
    lines = two_of(grid(4, 30)).splitlines()
    second = lines.index("o second")
    text = "\n".join(lines[:second] + ["vt 7 7" if line.startswith("vt") else line for line in lines[second:]]) + "\n"
    result, told = run(program, tmp_path, text, "--collapsed", collapsed)
    assert told["charts"][1]["fate"] == ("left" if collapsed == "leave" else "refined")
    assert ((7.0, 7.0) in uvs(result)) == (collapsed == "leave")


def test_no_seam_and_prefer_seam(program, tmp_path):
    text, edges = arc(12), tmp_path / "edges.txt"
    rectangles = ("--seams", "rectangles", "--cut", "edges", "--candidates", "20", "--best-effort")
    _, told = run(program, tmp_path, text, *rectangles)
    cuts = {tuple(sorted(pair)) for pair in told["new_seams"]}
    assert cuts
    edges.write_text("".join(f"{a} {b}\n" for a, b in sorted(cuts)))
    _, told = run(program, tmp_path, text, *rectangles, "--no-seam", edges)
    assert not cuts & {tuple(sorted(pair)) for pair in told["new_seams"]}
    next_row = 12 + 1
    beside = {(a + next_row, b + next_row) for a, b in cuts}
    assert not beside & cuts
    edges.write_text("".join(f"{a} {b}\n" for a, b in sorted(beside)))
    _, told = run(program, tmp_path, text, *rectangles, "--prefer-seam", edges)
    assert beside & {tuple(sorted(pair)) for pair in told["new_seams"]}
    edges.write_text("0 1 2\n")
    for option in ("--no-seam", "--prefer-seam"):
        assert str(edges) in program.refused(3, tmp_path / "in.obj", "-o", tmp_path / "x.obj", *rectangles, option, edges)


def test_triangulate(program, tmp_path):
    rectangles = ("--seams", "rectangles", "--candidates", "20")
    plain, _ = run(program, tmp_path, arc(12), *rectangles)
    result, _ = run(program, tmp_path, arc(12), *rectangles, "--triangulate")
    quads, left = ([face for face in records(text, "f") if len(face.split()) > 4] for text in (plain, result))
    whole = [face for face in left if max(int(corner.split("/")[0]) for corner in face.split()[1:]) <= 13 * 13]
    assert left == whole  # what no cut crosses stays as it is
    assert len(left) < len(quads)


def test_a_group_below_the_bound_keeps_its_uvs(program, tmp_path):
    """The others are written; the exit code and one line tell of the one that is not refined."""
    glass = "usemtl glass\nv 9 0 0\nv 10 0 0\nv 9 0.1 0\nvt 0.25 0.25\nvt 0.5 0.25\nvt 0.25 0.3\nf -3/-3 -2/-2 -1/-1\n"
    source, target, report = (tmp_path / each for each in ("in.obj", "out.obj", "report.json"))
    source.write_text("usemtl bark\n" + grid(4, 30).replace("usemtl material", "# material") + glass)
    done = program(source, "-o", target, "--report", report, "--group-by", "material")
    message = done.stderr.decode()
    assert done.returncode == 4
    assert message.count("\n") == 1
    assert "material glass keeps its UVs, the rest is written: " in message
    told = {group["name"]: group for group in json.loads(report.read_text())["groups"]}
    assert told["material bark"]["bound_met"]
    assert told["material bark"]["reason"] is None
    assert not told["material glass"]["bound_met"]
    assert "the bound 0.8 was not reached" in told["material glass"]["reason"]
    assert set(uvs(target.read_text())) >= {(0.25, 0.25), (0.5, 0.25), (0.25, 0.3)}


def test_kept_densities_are_not_given_up_for_the_bound(program, tmp_path):
    """A plank of one face as long as the box, and two squares that would have to fill the rest of it, unless it is stretched."""
    sizes = [(1, 16), (1, 1), (1, 1)]
    corners = [(3 * k + x * w, y * h) for k, (w, h) in enumerate(sizes) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1))]
    faces = ["f " + " ".join(f"{4 * k + i}/{4 * k + i}" for i in (1, 2, 3, 4)) for k in range(len(sizes))]
    text = "\n".join([f"v {x} {y} 0\nvt {x / 16} {y / 16}" for x, y in corners] + faces) + "\n"
    source, target = tmp_path / "plank.obj", tmp_path / "out_of_reach.obj"
    source.write_text(text)
    options = ("--aspect", "square", "--density", "keep", "--gap", "0.002")

    def growth(told):
        times = [chart["density_after"] / chart["density_before"] for chart in told["charts"]]
        return max(times) / min(times)

    _, told = run(program, tmp_path, text, *options)
    assert told["bound_met"]
    assert any("2 charts kept their shapes: bent, they would have grown to over 1.5 times" in line for line in told["warnings"])
    assert growth(told) < 1.1
    unbent = tmp_path / "unbent.txt"
    unbent.write_text("1\n0\n0\n")
    options += ("--keep-shape", unbent)
    message = program.refused(4, source, "-o", target, *options)
    assert "for more, 2 charts would grow to over 1.5 times the texel density of the others" in message
    assert not target.exists()
    _, told = run(program, tmp_path, text, *options, "--best-effort")
    assert not told["bound_met"]
    assert f"the best found is packing efficiency {told['after']['pe_fixed_aspect']:.4f}" in message
    assert any("the bound was not reached; for more, 2 charts" in line for line in told["warnings"])
    assert growth(told) < 1.8
