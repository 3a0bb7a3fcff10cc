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
from measure_file import Goal, Row
from study_statistics import statistics_lines
from table_rectangles import goal_lines

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
        ({"pe": 0.81}, 1),
        ({"nets": 1}, 1),
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
    other = row(e_d=1.2, bl=5.0, pe=0.5, nets=1, valid=False)
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
