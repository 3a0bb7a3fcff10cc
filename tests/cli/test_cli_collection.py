"""Several files as one atlas: each result in its own file, all of them or none."""

import json
import re

import pytest
from obj_shapes import box_efficiency, grid, records, uvs, without_uvs


@pytest.fixture
def models(tmp_path):
    """Three sheets in folders of their own."""
    paths = []
    for k in range(3):
        path = tmp_path / f"in{k}" / f"model {k}.obj"
        path.parent.mkdir()
        path.write_text(grid(2 + k, 30 * k, bump=0.1 * k, relative=k == 1, normals=k == 2))
        paths.append(path)
    return paths


def joined_uvs(folder):
    """All results as one text with vt records and faces only, as box_efficiency reads it."""
    points, faces = [], []
    for path in sorted(folder.glob("*.obj")):
        text, base = path.read_text(), len(points)
        own = records(text, "vt")
        for face in records(text, "f"):
            corners = [int(corner.split("/")[1]) for corner in face.split()[1:]]
            faces.append("f " + " ".join(f"1/{base + (k if k > 0 else len(own) + k + 1)}" for k in corners))
        points += own
    return "\n".join(points + faces)


@pytest.mark.parametrize("there", [False, True])
def test_one_atlas_for_all(program, tmp_path, models, there):
    folder, report = tmp_path / "out", tmp_path / "r.json"
    if there:
        folder.mkdir()
        (folder / "model 0.obj").write_text("the old file")
        (folder / "other").write_text("not ours")
    run = program(*models, "-o", folder, "--report", report)
    assert (run.returncode, run.stderr) == (0, b"")
    assert {p.name for p in folder.iterdir()} == {m.name for m in models} | ({"other"} if there else set())
    for model in models:
        result = (folder / model.name).read_text()
        assert without_uvs(result) == without_uvs(model.read_text())
        assert all(0 <= x <= 1 for uv in uvs(result) for x in uv)
    together = joined_uvs(folder)
    assert box_efficiency(together) >= 0.8
    told = json.loads(report.read_text())
    assert [entry["output"] for entry in told["files"]] == [str(folder / m.name) for m in models]
    assert [entry["faces"] for entry in told["files"]] == [4, 9, 16]
    assert told["after"]["chart_count"] == 3
    assert told["after"]["pe"] == pytest.approx(box_efficiency(together))


def test_folder_with_a_slash(program, tmp_path, models):
    assert program(*models, "-o", f"{tmp_path}/out/").returncode == 0
    assert len(list((tmp_path / "out").iterdir())) == 3


def test_results_may_replace_the_inputs(program, tmp_path):
    for k in range(2):
        (tmp_path / f"{k}.obj").write_text(grid(3, 30 + k))
    assert program(tmp_path / "0.obj", tmp_path / "1.obj", "-o", tmp_path).returncode == 0
    assert sorted(p.name for p in tmp_path.iterdir()) == ["0.obj", "1.obj"]
    assert box_efficiency(joined_uvs(tmp_path)) >= 0.8


def test_importance_counts_the_faces_of_all_files(program, tmp_path, models):
    weights = tmp_path / "weights.txt"
    weights.write_text("1\n" * 28)
    message = program.refused(3, *models, "-o", tmp_path / "out", "--importance", weights)
    assert message.endswith("ends after 28 numbers, there are 29 faces")
    weights.write_text("1 " * 29)
    assert program(*models, "-o", tmp_path / "out", "--importance", weights).returncode == 0


def test_refusals_leave_nothing(program, tmp_path, models):
    models[1].write_text(models[1].read_text() + "f 1/1 2/2 x/3\n")
    lines = models[1].read_text().count("\n")
    message = program.refused(3, *models, "-o", tmp_path / "out")
    assert message.startswith(f"atlas-refine: {models[1]}: line {lines}: ")
    assert not (tmp_path / "out").exists()
    assert str(tmp_path / "no.obj") in program.refused(3, models[0], tmp_path / "no.obj", "-o", tmp_path / "out")
    assert "its folder does not exist" in program.refused(2, *models, "-o", tmp_path / "a" / "b")
    (tmp_path / "out" / models[2].name).mkdir(parents=True)
    assert "is a folder" in program.refused(2, models[0], models[2], "-o", tmp_path / "out")
    assert [p.name for p in (tmp_path / "out").iterdir()] == [models[2].name]
    assert "a second file of this name" in program.refused(2, models[0], models[0], "-o", tmp_path / "out")


def test_a_face_is_named_by_file_and_line(program, tmp_path, models):
    """Where no face has finite UVs the library names the first, which it counts in the faces of all files."""
    for model in models:
        model.write_text(re.sub(r"^vt .*$", "vt 2e60 0", model.read_text(), flags=re.MULTILINE))
    message = program.refused(3, *models, "-o", tmp_path / "out")
    first = next(k for k, line in enumerate(models[0].read_text().splitlines(), 1) if line.startswith("f "))
    assert message.startswith(f"atlas-refine: {models[0]}: line {first}: ")


def test_report_may_not_be_one_of_the_results(program, tmp_path, models):
    for place in (tmp_path / "out" / models[1].name, models[2]):
        (tmp_path / "out").mkdir(exist_ok=True)
        program.refused(2, *models, "-o", tmp_path / "out", "--report", place)


def test_files_that_lie_at_one_place_share_no_chart(program, tmp_path):
    """Two sheets side by side in the UVs as in space: as one file they were one chart."""
    left, right, report = (tmp_path / name for name in ("left.obj", "right.obj", "r.json"))
    left.write_text(grid(4))
    shift = {"v": 1.0, "vt": 0.5}
    words = [line.split() for line in grid(4).splitlines()]
    moved = [[w[0], str(shift[w[0]] + float(w[1])), *w[2:]] if w[0] in shift else w for w in words]
    right.write_text("\n".join(map(" ".join, moved)) + "\n")
    run = program(left, right, "-o", tmp_path / "out", "--report", report, "--relax")
    assert run.returncode == 0, run.stderr
    told = json.loads(report.read_text())
    assert told["before"]["chart_count"] == 2
    assert told["before"]["seam_edges"] == 0
