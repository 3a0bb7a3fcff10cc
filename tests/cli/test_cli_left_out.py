"""Faces that no atlas can hold: the program does its work, tells of them, and writes them as they were."""

import json

import pytest
from obj_shapes import grid

# grid(8): 9 x 9 vertices and UVs
ODD_FACES = {
    "without UVs": ("f 1 2 3\n", "1 face has corners without UVs and is left out"),
    "two corners": ("f 1/1 2/2\n", "1 face has fewer than three different vertices and is left out"),
    "comes back": ("f 1/1 2/2 3/3 1/1 12/12\n", "1 face comes to a vertex twice and is left out"),
}


def records(text, keyword):
    return [line for line in text.splitlines() if line.startswith(keyword + " ")]


@pytest.mark.parametrize("cut", [False, True])
@pytest.mark.parametrize("case", ODD_FACES)
def test_a_face_left_out_is_reported_and_kept(program, tmp_path, case, cut):
    odd, note = ODD_FACES[case]
    source, target, report = (tmp_path / name for name in ("in.obj", "out.obj", "report.json"))
    plain = grid(8, 30)
    source.write_text(plain + odd)
    options = ["--seams", "rectangles", "--candidates", "20"] if cut else []
    run = program(source, "-o", target, "--report", report, *options)
    assert run.returncode == 0, run.stderr
    line = (plain + odd).count("\n")
    told = json.loads(report.read_text())
    assert f"{note} (line {line})" in told["warnings"]
    assert f"  warning: {note} (line {line})\n".encode() in run.stdout
    assert told["files"][0]["faces"] == len(records(plain, "f")) + 1
    kept = records(target.read_text(), "f")[-1]
    assert [corner.split("/")[0] for corner in kept.split()[1:]] == [corner.split("/")[0] for corner in odd.split()[1:]]

    source.write_text(plain)
    assert program(source, "-o", tmp_path / "plain.obj", *options).returncode == 0
    assert records((tmp_path / "plain.obj").read_text(), "vt") == records(target.read_text(), "vt")


def test_importance_has_a_number_for_faces_left_out_too(program, tmp_path):
    source, target, weights = (tmp_path / name for name in ("in.obj", "out.obj", "weights.txt"))
    source.write_text(grid(8, 30) + "f 1 2 3\n")
    count = len(records(source.read_text(), "f"))
    weights.write_text("1\n" * (count - 1))
    assert f"there are {count} faces" in program.refused(3, source, "-o", target, "--importance", weights)
    weights.write_text("1\n" * count)
    assert program(source, "-o", target, "--importance", weights).returncode == 0


@pytest.mark.parametrize("options", [[], ["--seams", "rectangles"], ["--seams", "rectangles", "--cut", "edges"]])
def test_a_keyhole_takes_part(program, tmp_path, options):
    """A square with a square hole as one polygon, which reaches the hole along an edge to and fro."""
    square = [(0, 0), (3, 0), (3, 3), (0, 3), (1, 1), (1, 2), (2, 2), (2, 1)]
    corners = [-8, -7, -6, -5, -8, -4, -3, -2, -1, -4]
    source, target, report = (tmp_path / name for name in ("in.obj", "out.obj", "report.json"))
    keyhole = [f"v {x} {y} 5" for x, y in square] + [f"vt {2 + x / 3} {y / 3}" for x, y in square]
    keyhole.append("f " + " ".join(f"{k}/{k}" for k in corners))
    source.write_text(grid(8, 30) + "\n".join(keyhole) + "\n")
    run = program(source, "-o", target, "--report", report, *options)
    assert run.returncode == 0, run.stderr
    told = json.loads(report.read_text())
    assert not [line for line in told["warnings"] if "left out" in line]
    assert len(told["charts"]) == 2
    assert told["after"]["pe"] >= 0.8
    assert told["before"]["seam_edges"] == 0
    if told["intervention"] != "cut":
        kept = records(target.read_text(), "f")[-1].split()[1:]
        assert [corner.split("/")[0] for corner in kept] == [str(k) for k in corners]
        assert kept[0] == kept[4]
        assert kept[5] == kept[9]
