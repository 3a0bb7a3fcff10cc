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


def refined(program, folder, text, *options):
    """The result, its report, and what was printed."""
    source, target, report = (folder / name for name in ("in.obj", "out.obj", "report.json"))
    source.write_text(text)
    run = program(source, "-o", target, "--report", report, *options)
    assert run.returncode == 0, run.stderr
    return target.read_text(), json.loads(report.read_text()), run.stdout


@pytest.mark.parametrize("cut", [False, True])
@pytest.mark.parametrize("case", ODD_FACES)
def test_a_face_left_out_is_reported_and_kept(program, tmp_path, case, cut):
    odd, note = ODD_FACES[case]
    plain = grid(8, 30)
    options = ["--seams", "rectangles", "--candidates", "20"] if cut else []
    text, told, printed = refined(program, tmp_path, plain + odd, *options)
    line = (plain + odd).count("\n")
    assert f"{note} (line {line})" in told["warnings"]
    assert f"  warning: {note} (line {line})\n".encode() in printed
    assert told["files"][0]["faces"] == len(records(plain, "f")) + 1
    kept = records(text, "f")[-1]
    assert [corner.split("/")[0] for corner in kept.split()[1:]] == [corner.split("/")[0] for corner in odd.split()[1:]]

    assert records(refined(program, tmp_path, plain, *options)[0], "vt") == records(text, "vt")


# grid(8) has 81 of each; what stands behind the grid, and what is told of the face on its last line but for the others
BAD_RECORDS = {
    "vertex behind the last": ("f 1/1 2/2 90/3\n", "names a vertex or UV that the file does not have"),
    "vertex before the first": ("f 1/1 2/2 -90/3\n", "names a vertex or UV that the file does not have"),
    "vertex zero": ("f 1/1 0/2 3/3\n", "names a vertex or UV that the file does not have"),
    "enormous index": ("f 1/1 99999999999999999999/2 3/3\n", "names a vertex or UV that the file does not have"),
    "UV behind the last": ("f 1/1 2/2 3/90\n", "names a vertex or UV that the file does not have"),
    "UV before the first": ("f 1/1 2/2 3/-90\n", "names a vertex or UV that the file does not have"),
    "UV NaN": ("vt nan 0\nf 1/1 2/2 3/-1\n", "has a UV that is not finite"),
    "UV of Windows": ("vt -1.#IND 0\nf 1/1 2/2 3/-1\n", "has a UV that is not finite"),
    "UV of new Windows": ("vt 0 -nan(ind)\nf 1/1 2/2 3/-1\n", "has a UV that is not finite"),
    "position NaN": ("v nan nan nan\nf 1/1 2/2 -1/3\n", "has a vertex whose position is not finite"),
    "position of Windows": ("v 0 1.#QNAN00 1.#INF\nf 1/1 2/2 -1/3\n", "has a vertex whose position is not finite"),
    "position too large": ("v 0 1e999 0\nf 1/1 2/2 -1/3\n", "has a vertex whose position is not finite"),
    "position behind its face": ("f 1/1 2/2 82/3\nv nan nan nan\n", "has a vertex whose position is not finite"),
    "UV behind its face": ("f 1/1 2/2 3/82\nvt inf 0\n", "has a UV that is not finite"),
}


def out_of_range(face, positions, uvs):
    """Whether some corner of the face's record names what a file with so many records does not have."""
    for corner in face.split()[1:]:
        for index, count in zip(corner.split("/"), (positions, uvs), strict=False):
            if not 0 < abs(int(index)) <= count:
                return True
    return False


@pytest.mark.parametrize("options", [[], ["--seams", "rectangles", "--candidates", "20"]])
@pytest.mark.parametrize("case", BAD_RECORDS)
def test_one_bad_record_costs_its_faces_only(program, tmp_path, case, options):
    bad, note = BAD_RECORDS[case]
    plain = grid(8, 30)
    text, told, _ = refined(program, tmp_path, plain + bad, "--pe-bound", "0.9", *options)
    line = plain.count("\n") + 1 + bad[: bad.index("f ")].count("\n")
    assert told["warnings"][0] == f"1 face {note} and is left out (line {line})"
    assert all(record in text.splitlines() for record in bad.splitlines() if record[0] == "v")
    kept = records(text, "f")[-1]
    assert len(kept.split()) == 4
    positions, uvs = len(records(text, "v")), len(records(text, "vt"))
    assert out_of_range(kept, positions, uvs) == ("vertex or UV" in note)
    if not options:
        assert records(text, "v") == records(plain + bad, "v")
        assert kept == records(bad, "f")[0]


def test_a_bad_record_that_no_face_names_costs_nothing(program, tmp_path):
    plain, unused = grid(8, 30), "v nan nan nan\nvt -1.#IND nan\nl 1 -999\n"
    text, told, _ = refined(program, tmp_path, plain + unused, "--pe-bound", "0.9")
    assert [x for x in told["warnings"] if "left out" in x] == []
    assert text == refined(program, tmp_path, plain, "--pe-bound", "0.9")[0] + unused


@pytest.mark.parametrize("options", [[], ["--seams", "rectangles", "--candidates", "20"]])
def test_a_normal_that_is_not_there_costs_no_face(program, tmp_path, options):
    source, target, report = (tmp_path / name for name in ("in.obj", "out.obj", "report.json"))
    plain = grid(8, 30)
    first = plain.index("f ")
    face = plain[first:].splitlines()[0]
    corners = face.split()[1:]
    bad = "f " + " ".join([f"{corners[0]}/1", f"{corners[1]}/2", *(f"{corner}/-1" for corner in corners[2:])])
    source.write_text(plain[:first] + "vn 0 0 1\n" + bad + plain[first + len(face) :])
    run = program(source, "-o", target, "--report", report, "--pe-bound", "0.9", *options)
    assert run.returncode == 0, run.stderr
    line = plain[:first].count("\n") + 2
    told = json.loads(report.read_text())
    assert f"1 face names a normal that the file does not have (line {line})" in told["warnings"]
    assert len([x for x in told["warnings"] if "left out" in x]) == 0
    if not options:
        assert records(target.read_text(), "f")[0] == bad


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
