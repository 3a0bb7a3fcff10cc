"""The breakdown of a run: every phase is shown, nothing is counted twice, and a run that fails says why."""

import json
import sys
from pathlib import Path

import profiles
from measure_file import Goal

ROOT = Path(__file__).resolve().parents[2]
REPORT = {
    "iterations": 12,
    "profile": {
        "phases": {phase: 0.5 for phase in profiles.PHASES if phase != "files"},
        "files": 0.25,
        "steps": 20,
        "mean_step": 0.8,
    },
}


def row(**changed):
    return {"file": "disk/a", "goal": "0.80 free", **profiles.profile_of(REPORT), "peak_mb": 100.0, **changed}


def program(folder, *lines):
    path = folder / "program"
    path.write_text(f"#!{sys.executable}\nimport json, sys\n" + "\n".join(lines))
    path.chmod(0o755)
    return path


def test_the_phases_are_those_of_the_report():
    schema = json.loads((ROOT / "docs" / "report.schema.json").read_text())
    assert {*schema["$defs"]["profile"]["properties"]["phases"]["required"], "files"} == set(profiles.PHASES)


def test_a_line_has_a_cell_for_every_phase_under_its_name():
    names, cells = profiles.header().split()[1:], profiles.line(row()).split()[1:]
    assert len(cells) == len(names) + 1  # the bound is two words
    assert cells[2] == "6.75"
    assert cells[-4:] == ["12", "20", "0.80", "100"]


def test_sums_weigh_the_mean_step_by_steps():
    lines = profiles.summary(
        [row(), row(steps=60, mean_step=0.4, peak_mb=200.0), row(goal="0.90 free"), {"file": "b", "goal": "x", "reason": "no"}]
    )
    assert len(lines) == 4
    assert lines[0].split()[:5] == ["all", "2", "files", "0.80", "free"]
    assert lines[0].split()[-4:] == ["24", "80", "0.50", "200"]
    assert "7.4" in lines[1]  # 0.5 of 6.75 s, per cent


def test_the_shortest_of_the_runs_counts(tmp_path):
    (tmp_path / "runs").write_text("3 1 2")
    path = program(
        tmp_path,
        f"runs = open({str(tmp_path / 'runs')!r}).read().split()",
        f"open({str(tmp_path / 'runs')!r}, 'w').write(' '.join(runs[1:]))",
        f"report = {REPORT!r}",
        "report['profile']['files'] = float(runs[0])",
        "json.dump(report, open(sys.argv[sys.argv.index('--report') + 1], 'w'))",
    )
    found = profiles.measured(path, "mine", Path("a.obj"), Goal(0.8))
    assert found["seconds"]["files"] == 1.0
    assert (tmp_path / "runs").read_text() == ""


def test_a_run_that_fails_says_why(tmp_path):
    found = profiles.measured(program(tmp_path, "sys.exit('nothing there')"), "mine", Path("a.obj"), Goal(0.8))
    assert "nothing there" in profiles.line(found)
    assert profiles.summary([found]) == []
