"""The benchmark itself: what it measures of a process, which goals it asks for, and that its verdicts can fail."""

import argparse
import json
import math
import subprocess
import sys
import time
from pathlib import Path

import bench
import measure_file
import pytest
import studies
import table
from measure_file import Goal, Row
from meshes import VARIABLE, NoMeshesError, folder_meshes, mesh_root, own_meshes
from study_statistics import statistics_lines
from table_rectangles import goal_lines
from table_roads import road_lines

MIB = 2**20


def measured(tmp_path, code):
    figures = tmp_path / "figures.json"
    command = [sys.executable, "-S", "-E", Path(measure_file.__file__).with_name("run_measured.py"), figures]
    run = subprocess.run([*command, sys.executable, "-S", "-c", code], check=False)
    return run.returncode, json.loads(figures.read_text())


def test_peak_memory_is_the_programs_own(tmp_path):
    ballast = bytearray(200 * MIB)
    ballast[::4096] = b"x" * len(ballast[::4096])
    assert measured(tmp_path, "pass")[1]["peak_bytes"] < 60 * MIB
    assert 100 * MIB <= measured(tmp_path, "x = b'x' * (100 << 20)")[1]["peak_bytes"] < 160 * MIB


def test_processor_time_and_exit_code(tmp_path):
    code, figures = measured(tmp_path, "import time\nwhile time.process_time() < 0.3: pass\nraise SystemExit(3)")
    assert code == 3
    assert 0.3 <= figures["cpu_seconds"] < 2
    assert measured(tmp_path, "import os; os.kill(os.getpid(), 11)")[0] == 139


def test_what_does_not_end_is_ended_with_all_it_started(tmp_path):
    started = time.monotonic()
    alive = tmp_path / "alive"
    assert measure_file.run_limited(["sh", "-c", f"(sleep 2; touch {alive}) & wait"], 0.3) is None
    assert time.monotonic() - started < 1.5
    time.sleep(2.2)
    assert not alive.exists()


def test_results_with_and_without_cuts_stand_beside_each_other():
    arguments = argparse.Namespace(bounds=None, seams=["none", "rectangles"])
    names = [goal.name for goal in bench.goals_of(arguments, "disk_deep")]
    assert names[:4] == ["0.80 free", "0.80 free rect", "0.90 free", "0.90 free rect"]
    assert {"0.85 free rect", "0.80 square rect"} <= set(names)
    assert [goal.name for goal in bench.goals_of(arguments, "disk") if goal.cuts] == ["0.80 free rect"]
    arguments = argparse.Namespace(bounds=[Goal(0.7, "square")], seams=["rectangles"])
    assert [goal.name for goal in bench.goals_of(arguments, "disk")] == ["0.70 square rect"]


def row(**changed):
    figures = {
        "triangles": 1000, "vertices": 500, "charts": 5, "smallest": 0.1, "valid": True, "met": True, "bl_in": 1.0, "bl": 1.5, "pe": 0.83, "e_d_in": 1.05,
        "e_d": 1.05, "e_2": 1.01, "seconds": 1.0, "cpu_seconds": 1.1, "newton_seconds": 0.02, "peak_bytes": 50.0 * MIB,
    }  # fmt: skip
    return Row("disk_deep", "a", "0.80 free rect", "rectangles", **(figures | changed))


@pytest.mark.parametrize(
    ("changed", "count"),
    [
        ({}, 0),
        ({"valid": False, "reason": "borders"}, 1),
        ({"met": False}, 1),
        ({"e_d": 1.06}, 1),
        ({"bl": 1.9}, 1),
        ({"bl": 3.0}, 2),
        ({"fallbacks": ["chart 0: could not be deformed; embedded onto a rectangle"]}, 1),
        ({"triangles": 21000, "seconds": 2.1, "cpu_seconds": 2.2}, 1),
        ({"triangles": 60000, "seconds": 7.0, "cpu_seconds": 7.0}, 0),
        ({"triangles": 99000, "seconds": 13.0, "cpu_seconds": 13.0}, 1),
        ({"peak_bytes": 1100.0 * MIB}, 1),
    ],
)
def test_each_verdict_can_fail(changed, count):
    lines = goal_lines([row(**changed)])
    assert sum(line.count("NO") + (": not " in line) for line in lines) == count


def test_quality_is_judged_at_one_bound_and_validity_everywhere():
    other = row(e_d=1.2, bl=5.0, pe=0.5, fallbacks=["first this, then that"], valid=False)
    other.goal = "0.90 free rect"
    assert sum(line.count("NO") for line in goal_lines([other])) == 1


def test_a_file_without_seams_has_no_growth_of_them():
    assert math.isnan(row(bl_in=0.0, bl=0.0).added_length)
    assert row().added_length == pytest.approx(0.5)
    assert row(e_d=1.0605).growth == pytest.approx(0.01)
    assert not row(valid=False).ok


def test_statistics_of_good_rows_only():
    results = [(row(e_d=e), studies.Figures("a", "b", sae=0.01)) for e in (1.05, 1.071)]
    results.append((row(e_d=9.0, valid=False), studies.Figures("a", "b")))
    lines = statistics_lines("rectangles", results)
    assert lines[0].startswith("rectangles: 2 of 3 files")
    growth = next(line for line in lines if line.strip().startswith("dE %"))
    assert growth.split()[2:6] == ["2.0000", "1.0000", "1.0000", "0.0000"]
    assert growth.endswith("-, 0.0533, -")
    assert not any("SAE in" in line for line in lines)


def test_lines_of_a_study_stand_under_their_header():
    theirs, ours = studies.PAPER["sigma"][0], studies.Figures("a", "b", 5, reason="none")
    end = studies.header().index("t1/t2/t3")
    assert studies.line(theirs)[:end].split()[-3:] == ["1.0220", "0.0131", "0.0047"]
    assert studies.line(ours)[:end].split() == ["a", "b", "5"] + ["-"] * 11
    assert studies.line(theirs).index("3.82/0.20/8.58") == end
    assert studies.line(ours).endswith("none")


def test_fallbacks_of_a_report_are_the_nets():
    measures = dict.fromkeys(
        ("chart_count", "smallest_chart", "small_charts", "boundary_length", "pe_fixed_aspect", "distortion"), 1
    )
    measures |= dict.fromkeys(("stretch_99", "stretch_max", "gap_within", "distortion_to_input"), 1.0)
    report = {
        "before": measures, "after": measures, "files": [{"vertices": 4}], "intervention": "squeezed", "charts": [], "price": 0,
        "gap": {"value": 0.0025, "unit": "box_diagonal"}, "iterations": 3, "seconds": {"refine": 0.1}, "timings": [],
    }  # fmt: skip
    filled = row()
    measure_file.fill_from_report(filled, report)
    assert filled.nets == 0
    report["fallbacks"] = ["chart 0: not cut: squeezed", "chart 1: likewise"]
    measure_file.fill_from_report(filled, report)
    assert (filled.nets, filled.as_json()["nets"]) == (2, 2)
    assert "chart 0: not cut: squeezed; chart 1: likewise" in "\n".join(goal_lines([filled]))


def two_roads(file, squeeze, cut):
    """The rows of one file; `squeeze` and `cut` are what differs from a good row."""
    one, other = row(**({"bl": 1.0, "added_seams": 0} | squeeze)), row(**cut)
    one.goal, one.seams, one.file, other.file = "0.80 free", "none", file, file
    return [one, other]


def test_two_roads_side_by_side():
    rows = two_roads("a", {"e_d": 1.02, "cpu_seconds": 2.0}, {"e_d": 1.04}) + two_roads("b", {"e_d": 1.04}, {"e_d": 1.01})
    rows += two_roads("c", {"e_d": 1.01}, {"e_d": 1.02, "pe": 0.85}) + two_roads("equal", {}, {})
    rows += two_roads("fails", {"e_d": 9.0, "valid": False}, {}) + two_roads("distorted", {"e_d_in": 3.0}, {"e_d_in": 3.0})
    title, _, squeeze, rectangles = road_lines(rows)
    assert not any("that are cut" in line for line in road_lines(rows))
    assert title.startswith("two roads at 0.80 free: 4 of 6 files")
    assert squeeze.split() == "disk_deep 4 squeeze 1.0500 1.0300 0.830 +0.0% 1.33 2 of 4".split()
    assert rectangles.split() == "4 rectangles 1.0500 1.0300 0.835 +50.0% 1.10 1 of 4".split()
    assert road_lines([r for r in rows if r.cuts]) == []


@pytest.mark.parametrize(("e_d", "judged"), [(1.03, "yes"), (1.05, "NO")])
def test_files_that_are_cut_are_held_against_the_squeeze(e_d, judged):
    """The file that was not cut after all does not count."""
    rows = two_roads("a", {"e_d": 1.04}, {"how": "cut", "e_d": e_d}) + two_roads(
        "b", {"e_d": 1.5}, {"how": "squeezed", "e_d": 1.0}
    )
    assert road_lines(rows)[-1] == f"    of the 1 that are cut: E_d {e_d:.4f} (at most the squeeze's 1.0400: {judged})"


def test_two_roads_of_several_folders_and_bounds():
    rows = two_roads("a", {}, {}) + two_roads("b", {}, {})
    for one in rows[2:]:
        one.folder = "disk"
    assert [line.split()[0] for line in road_lines(rows)] == ["two", "files", "disk_deep", "1", "disk", "1", "all", "2"]
    for one in rows[2:]:
        one.goal = one.goal.replace("0.80", "0.90")
    assert [line.split(":")[0] for line in road_lines(rows) if "roads" in line] == [
        "two roads at 0.80 free",
        "two roads at 0.90 free",
    ]


def test_own_meshes_need_no_structure(tmp_path):
    for name in ("deep/er/a.obj", "deep/b.OBJ", "deep/notes.txt", "single/c.obj"):
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text("")
    found = own_meshes([tmp_path / "deep", tmp_path / "single" / "c.obj"])
    assert {folder: sorted(path.name for path in paths) for folder, paths in found.items()} == {
        "deep": ["a.obj", "b.OBJ"],
        "single": ["c.obj"],
    }
    with pytest.raises(NoMeshesError, match="there is no"):
        own_meshes([tmp_path / "missing"])
    (tmp_path / "empty").mkdir()
    with pytest.raises(NoMeshesError, match="no OBJ file in"):
        own_meshes([tmp_path / "empty"])


def test_test_meshes_are_those_of_the_variable_or_the_shared_folder(tmp_path, monkeypatch):
    monkeypatch.delenv(VARIABLE, raising=False)
    with pytest.raises(NoMeshesError, match=f"{VARIABLE} is not set"):
        mesh_root(tmp_path)
    (tmp_path / "data").mkdir()
    (tmp_path / "data" / "unpack.sh").write_text(f"echo unpacking; echo {tmp_path}")
    with pytest.raises(NoMeshesError, match="holds no disk/"):
        mesh_root(tmp_path)
    (tmp_path / "disk").mkdir()
    (tmp_path / "disk" / "a.obj").write_text("")
    assert mesh_root(tmp_path) == tmp_path
    monkeypatch.setenv(VARIABLE, str(tmp_path / "elsewhere"))
    with pytest.raises(NoMeshesError, match="elsewhere holds no disk/"):
        mesh_root(tmp_path)
    assert folder_meshes(tmp_path, ["disk", "disk_deep"]) == {"disk": [tmp_path / "disk" / "a.obj"], "disk_deep": []}


def run_bench(*arguments):
    command = [sys.executable, Path(bench.__file__), *map(str, arguments)]
    return subprocess.run(command, capture_output=True, text=True, check=False)


def test_without_meshes_one_line_says_both_ways(tmp_path):
    run = run_bench("--meshes", tmp_path)
    assert (run.returncode, run.stdout, run.stderr.count("\n")) == (1, "", 1)
    assert run.stderr.startswith("bench: no meshes: ")
    assert "--meshes" in run.stderr
    assert VARIABLE in run.stderr
    assert run_bench("--meshes", tmp_path, "--study", "sae").returncode == 2


def test_summary_of_own_meshes_judges_them():
    own = row()
    own.folder = "mine"
    lines = table.summary([own])
    assert "cuts at 0.80 free rect, mine" in lines
    assert not any("disk_deep/" in line for line in lines)


def test_only_studies_of_the_optimum_leave_out_the_papers_stop():
    assert studies.RECTANGLES.command_line()[-1] == "--until-input"
    assert studies.with_options(studies.RECTANGLES, "--gap", "0").command_line()[-3:] == ["--until-input", "--gap", "0"]
    assert not {"--until-input"} & {*studies.OPTIMUM.command_line(), *studies.SQUEEZE.command_line()}


def test_a_texture_of_any_shape_is_a_goal():
    assert (bench.goal("0.8").aspect, bench.goal("0.8:16:9").aspect) == ("free", "16:9")
    with pytest.raises(ValueError, match="wide"):
        bench.goal("0.8:wide")
