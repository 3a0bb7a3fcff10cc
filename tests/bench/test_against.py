"""The comparison of two programs: which program runs when and with what, how a commit is built, what its verdicts say."""

import argparse
import json
import math
import subprocess
import sys

import against
import bench
import pytest
import trees
from measure_file import Goal, Row

SQUARE = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n"
MEASURES = {
    "chart_count": 1, "smallest_chart": 1.0, "small_charts": 0, "boundary_length": 0.0, "pe_fixed_aspect": 1.0, "distortion": 1.0,
    "distortion_to_input": 1.0, "stretch_99": 1.0, "stretch_max": 1.0, "gap_within": None,
}  # fmt: skip
REPORT = {
    "intervention": "moved", "before": MEASURES, "after": MEASURES, "files": [{"vertices": 4}], "charts": [], "price": 0, "iterations": 0,
    "gap": {"value": 0.0, "unit": "box_diagonal"}, "seconds": {"refine": 0.1}, "timings": [],
}  # fmt: skip


def program(folder, name, stretch):
    """Copies its input with v of every UV multiplied and tells its options to a log beside it."""
    path = folder / name
    path.write_text(f"""#!{sys.executable}
import json, sys
words = sys.argv[1:]
with open({str(folder / "log")!r}, "a") as log:
    log.write(json.dumps([{name!r}, *words[words.index("--seams") + 2 : words.index("--threads")]]) + "\\n")
report = {REPORT!r}
report["after"]["distortion"] = ({stretch} + 1 / {stretch}) / 2
with open(words[0]) as source, open(words[words.index("-o") + 1], "w") as result:
    result.write("".join(f"vt {{l.split()[1]}} {{float(l.split()[2]) * {stretch}}}\\n" if l.startswith("vt") else l for l in source))
with open(words[words.index("--report") + 1], "w") as out:
    json.dump(report, out)
""")
    path.chmod(0o755)
    return path


def test_both_programs_run_in_turn_with_their_own_options(tmp_path):
    mesh = tmp_path / "square.obj"
    mesh.write_text(SQUARE)
    programs = against.Programs(program(tmp_path, "old", 1.0), program(tmp_path, "new", 0.5), ("--old-way",), ("--new-way", "2"))
    goals = [Goal(0.8), Goal(0.9, options=("--both",))]
    pairs = against.compare_file(programs, "mine", mesh, goals)
    runs = [json.loads(text) for text in (tmp_path / "log").read_text().splitlines()]
    assert runs == [
        *against.REPEATS * [["old", "--old-way"], ["new", "--new-way", "2"]],
        *against.REPEATS * [["old", "--both", "--old-way"], ["new", "--both", "--new-way", "2"]],
    ]
    assert [pair.new.goal for pair in pairs] == ["0.80 free", "0.90 free"]
    assert pairs[0].both_ok
    assert pairs[0].difference == pytest.approx(0.25)
    assert pairs[0].worse
    assert pairs[0].ratio > 0


@pytest.mark.parametrize(("stretch", "wrong"), [(1.0, 0), (0.5, 1)])
def test_a_run_counts_what_is_worse_and_leaves_its_table(tmp_path, monkeypatch, capsys, stretch, wrong):
    (tmp_path / "square.obj").write_text(SQUARE)
    builds = {}
    for name, by in (("old", 1.0), ("new", stretch)):
        builds[name] = tmp_path / name
        builds[name].mkdir()
        program(builds[name], trees.PROGRAM, by)
    monkeypatch.setattr(trees, "build_commit", lambda *_: builds["old"])
    arguments = argparse.Namespace(
        against="COMMIT", build=builds["new"], cache=tmp_path, old_options=(), new_options=(), jobs=1, bounds=[Goal(0.8)],
        seams=["none"], found={"mine": [tmp_path / "square.obj"]},
    )  # fmt: skip
    assert bench.run_against(arguments, tmp_path) == wrong
    assert "mine: ok 1 -> 1 of 1" in capsys.readouterr().out
    assert json.loads((tmp_path / "against.json").read_text())[0]["new"]["e_d_checked"] == pytest.approx(1 + wrong / 4)
    assert (tmp_path / "against.md").read_text().startswith("This tree against COMMIT")


def row(folder="disk", file="a", goal="0.80 free", **changed):
    figures = {
        "how": "squeezed",
        "valid": True,
        "met": True,
        "added_seams": 0,
        "bl_in": 1.0,
        "bl": 1.0,
        "pe": 0.8,
        "e_d_checked": 1.02,
        "cpu_seconds": 2.0,
    }
    return Row(folder, file, goal, **(figures | changed))


def pair(old=None, new=None, **both):
    return against.Pair(row(**both, **(old or {})), row(**both, **(new or {})))


@pytest.mark.parametrize(
    ("old", "new", "lost", "worse"),
    [
        ({}, {}, False, False),
        ({}, {"e_d_checked": 1.0204}, False, False),
        ({}, {"e_d_checked": 1.0206}, False, True),
        ({}, {"e_d_checked": 1.0}, False, False),
        ({}, {"valid": False, "e_d_checked": 1.5}, True, False),
        ({"met": False}, {"met": False}, False, False),
        ({"met": False}, {}, False, False),
    ],
)
def test_verdicts(old, new, lost, worse):
    compared = pair(old, new)
    assert (compared.lost, compared.worse) == (lost, worse)


def test_summary_by_road_and_folder():
    pairs = [
        pair({}, {"e_d_checked": 1.04, "cpu_seconds": 1.0}),
        pair({"cpu_seconds": 8.0}, {"e_d_checked": 1.01, "cpu_seconds": 8.0}, file="b"),
        pair({}, {"valid": False, "e_d_checked": 9.0, "reason": "borders"}, file="c"),
        pair(folder="disk_deep"),
        pair({}, {"bl": 1.5}, goal="0.80 free rect", seams="rectangles"),
    ]
    lines = against.summary(pairs)
    assert [line for line in lines if not line.startswith(" ")] == ["0.80 free", "0.80 free rect"]
    disk = lines[1:5]
    assert disk[0] == "  disk: ok 3 -> 2 of 3"
    assert disk[1] == "    means of 2: E_d 1.0200 -> 1.0250; PE 0.8000 -> 0.8000; BL+ 0.0 -> 0.0 %"
    assert disk[2] == "    E_d worse by more than 0.0005: 1, better: 1; worst difference +0.0200 (disk/a)"
    assert disk[3] == "    processor time, new / old: median 0.750, total 0.900 (10.0 s -> 9.0 s)"
    assert "  all: ok 4 -> 3 of 4" in lines
    assert "  no longer valid and at the bound: disk/c: borders" in lines
    assert "  worse: disk/a: E_d +0.0200" in lines
    assert any("BL+ 0.0 -> 50.0 %" in line for line in lines)


def test_a_group_without_results_has_its_counts_only():
    assert against.group_lines("disk", [pair({"valid": False}, {"valid": False})]) == ["  disk: ok 0 -> 0 of 1"]
    assert math.isnan(pair({"e_d_checked": math.nan}).difference)


def test_lines_stand_under_their_header():
    shown = against.line(pair({"reason": "gap"}, {"e_d_checked": math.nan}))
    start = against.header().index("E_d old")
    assert shown[start : start + 25].split() == ["1.0200", "-", "-"]
    assert shown.endswith("old: gap")


@pytest.fixture
def repository(tmp_path):
    """Two commits, each of which builds a program that prints its own name."""
    root = tmp_path / "repository"
    root.mkdir()

    def git(*arguments):
        identity = ("-c", "user.name=Test", "-c", "user.email=test@example.org")
        subprocess.run(["git", "-C", root, *identity, *arguments], check=True, capture_output=True)

    git("init", "-q")
    for name in ("first", "second"):
        lines = "cmake_minimum_required(VERSION 3.25)", "project(stub LANGUAGES NONE)", "add_custom_target(atlas-refine)"
        text = "\n".join([*lines, f'file(WRITE ${{CMAKE_BINARY_DIR}}/atlas-refine "{name}")'])
        (root / "CMakeLists.txt").write_text(text)
        git("add", ".")
        git("commit", "-q", "-m", name)
    return root


def test_a_commit_is_built_beside_the_tree(repository, tmp_path):
    folder = trees.build_commit("HEAD~1", repository, tmp_path / "cache")
    assert (folder / trees.PROGRAM).read_text() == "first"
    assert "second" in (repository / "CMakeLists.txt").read_text()
    assert trees.build_commit("HEAD~1", repository, tmp_path / "cache") == folder
    assert (trees.build_commit("HEAD", repository, tmp_path / "cache") / trees.PROGRAM).read_text() == "second"


def test_a_commit_that_cannot_be_built_is_named(repository, tmp_path):
    with pytest.raises(trees.TreeError, match=r"^git rev-parse .*nothing"):
        trees.build_commit("nothing", repository, tmp_path / "cache")
    with pytest.raises(trees.TreeError, match="is not built"):
        trees.require_built(tmp_path, trees.PROGRAM)
    with pytest.raises(trees.TreeError, match="not a git repository"):
        trees.build_commit("HEAD", tmp_path, tmp_path / "cache")
