"""Real files: every ending is told apart, and what was left is no defect of the result."""

import stat

import check_atlas
import pytest
import real
from measure_file import Goal
from test_check_atlas import GOOD, problems

POINT = "v 9 0 0\nv 9 1 0\nv 9 0 1\nvt 5 5\nf -3/-1 -2/-1 -1/-1\n"
LEFT_OUT = "vt 7 7\nf 1 2 3\nf 1/-1 2/2\nf 1/1 2/2 3/3 1/1 4/4\nvt nan 0\nf 1/-1 2/2 3/3\n"


def program(tmp_path, script):
    path = tmp_path / "program"
    path.write_text(f"#!/bin/sh\n{script}\n")
    path.chmod(path.stat().st_mode | stat.S_IXUSR)
    return path


@pytest.mark.parametrize(
    ("script", "how", "why"),
    [
        ("echo 'atlas-refine: x: no faces' >&2; exit 3", "refused", "no faces"),
        ("echo 'atlas-refine: x: the bound' >&2; exit 4", "refused", "the bound"),
        ("echo 'atlas-refine: internal error: x' >&2; exit 1", "crash", "internal error"),
        ("kill -SEGV $$", "crash", "no message"),
        ("while :; do :; done", "hang", "no end after"),
        ("sleep 30", "hang", "no end after"),
    ],
)
def test_endings_without_a_result(tmp_path, monkeypatch, script, how, why):
    monkeypatch.setattr(real, "LIMIT_S", 1)
    monkeypatch.setattr(real, "PATIENCE", 3)
    mesh = tmp_path / "in.obj"
    mesh.write_text(GOOD)
    ending = real.run_file(program(tmp_path, script), "folder", mesh, "in", Goal(0.8))
    assert ending.how == how
    assert why in ending.why
    assert ending.failed == (how != "refused")


def test_every_file_has_a_line_and_failures_count(tmp_path, capsys):
    files = []
    for k in range(3):
        mesh = tmp_path / f"{k}.obj"
        mesh.write_text(GOOD)
        files.append(("uv/some", mesh))
    bad = program(tmp_path, "exit 9")
    assert real.run_real(bad, files, Goal(0.8), 2, tmp_path, tmp_path / "real.json") == 3
    told = capsys.readouterr().out
    assert all(f"uv/some/{k} " in told for k in range(3))
    assert "0.0 % not refused, 3 failures (3 crash)" in told


def test_charts_without_area_are_no_defect(tmp_path):
    assert problems(tmp_path, GOOD + POINT) == ""
    assert "they differ" in problems(tmp_path, (GOOD + POINT).replace("vt 5 5", "vt 5 6"), before=GOOD + POINT)


def test_faces_that_are_left_out_are_no_defect_but_must_stay(tmp_path):
    assert problems(tmp_path, GOOD + LEFT_OUT) == ""
    assert problems(tmp_path, GOOD + LEFT_OUT.replace("vt 7 7", "vt 7 8"), before=GOOD + LEFT_OUT) != ""
    assert problems(tmp_path, GOOD + LEFT_OUT.replace("f 1 2 3\n", ""), before=GOOD + LEFT_OUT) != ""


def test_what_the_report_says_was_left_is_not_checked(tmp_path):
    overlapping = GOOD + "v 20 0 0\nv 21 0 0\nv 20 1 0\nvt 0.1 0.1\nvt 0.2 0.1\nvt 0.1 0.2\nf -3/-3 -2/-2 -1/-1\n"
    (tmp_path / "a.obj").write_text(overlapping)
    faces = overlapping.count("\nf ")
    fates = [{"fate": "refined", "face_ranges": None}, {"fate": "left", "face_ranges": [[faces - 1, faces - 1]]}]
    assert check_atlas.check(tmp_path / "a.obj", tmp_path / "a.obj", charts=fates)["problems"] == []
    fates[-1]["fate"] = "refined"
    assert check_atlas.check(tmp_path / "a.obj", tmp_path / "a.obj", charts=fates)["problems"] != []


def test_what_is_stacked_must_lie_on_the_atlas(tmp_path):
    pile = GOOD + "".join(line + "\n" for line in GOOD.splitlines() if line.startswith("f "))
    faces = GOOD.count("\nf ")
    fates = [{"fate": "refined", "face_ranges": None}, {"fate": "stacked", "face_ranges": [[faces, 2 * faces - 1]]}]
    (tmp_path / "a.obj").write_text(pile)
    assert check_atlas.check(tmp_path / "a.obj", tmp_path / "a.obj", charts=fates)["problems"] == []
    astray = pile + "vt 0.5 3\n" + f"f 1/{1 + GOOD.count('vt ')} 2/2 3/3\n"
    fates[1]["face_ranges"] = [[faces, 2 * faces]]
    (tmp_path / "a.obj").write_text(astray)
    assert "1 corners lie on no" in check_atlas.check(tmp_path / "a.obj", tmp_path / "a.obj", charts=fates)["problems"][0]


def test_homogeneous_positions(tmp_path):
    scaled = GOOD.replace("v 0.0 0.0 0.0\n", "v 0.0 0.0 0.0 4\n").replace("v 1.0 1.0 0.0\n", "v 2.0 2.0 0.0 2\n")
    assert scaled != GOOD
    for name, text in (("plain", GOOD), ("scaled", scaled)):
        (tmp_path / f"{name}.obj").write_text(text)
    plain, same = (check_atlas.check(tmp_path / f"{name}.obj", tmp_path / f"{name}.obj") for name in ("plain", "scaled"))
    assert plain["e_d"] == same["e_d"]


def test_reasons_are_told_by_kind():
    one, other = "exit 3: line 257: face 0 of chart 0 is flipped (and 2 more)", "exit 3: line 9: face 12 of chart 3 is flipped"
    assert real.kind_of(one) == real.kind_of(other) == "face N of chart N is flipped"
