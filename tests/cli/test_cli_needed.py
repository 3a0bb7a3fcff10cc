"""Cuts where they are needed, and the trade-off, as the program is asked for them."""

import csv
import json

import pytest
from obj_shapes import arc


@pytest.fixture
def source(tmp_path):
    path = tmp_path / "in.obj"
    path.write_text(arc(24))
    return path


def run(program, source, *options):
    report = source.parent / "report.json"
    done = program(source, "-o", source.parent / "out.obj", "--report", report, *options)
    assert done.returncode == 0, done.stderr.decode()
    return json.loads(report.read_text())


def test_a_limit_is_kept_with_few_seams(program, source):
    whole = run(program, source)
    limit = 1 + 0.5 * (whole["after"]["distortion"] - 1)
    cut = run(program, source, "--seams", "needed", "--max-distortion", str(limit))
    assert cut["after"]["distortion"] <= limit
    assert cut["after"]["pe"] >= 0.8
    assert cut["cuts"]["cuts"] >= 1
    assert cut["boundary_growth"] > 0
    assert cut["intervention"] == "cut"
    assert cut["options"]["needed"]["effort"] == "normal"


def test_a_limit_of_stretch_is_kept_with_few_seams(program, source):
    whole = run(program, source)
    limit = 1 + 0.6 * (whole["after"]["stretch_99"] - 1)
    cut = run(program, source, "--seams", "needed", "--max-stretch", str(limit))
    assert cut["after"]["stretch_99"] <= limit * (1 + 1e-5)
    assert cut["after"]["pe"] >= 0.8
    assert cut["boundary_growth"] > 0
    assert cut["options"]["max_stretch"] == limit


def test_a_budget_of_seams_is_kept(program, source):
    told = run(program, source, "--seams", "needed", "--seam-cost", "0.001", "--max-boundary-growth", "0.12")
    assert 0 < told["boundary_growth"] <= 0.12
    none = run(program, source, "--seams", "needed", "--max-boundary-growth", "0")
    assert none["boundary_growth"] == 0
    assert none["intervention"] == "squeezed"


def test_the_trade_off_is_a_table_and_a_picture(program, source, tmp_path):
    table = tmp_path / "t.csv"
    told = run(program, source, "--seams", "needed", "--effort", "fast", "--trade-off", table)
    rows = list(csv.DictReader(table.open()))
    seams = [row for row in rows if row["kind"] == "seams"]
    packing = [float(row["distortion"]) for row in rows if row["kind"] == "packing"]
    assert len(seams) == len(told["cuts"]["trade_off"]) >= 2
    assert len(packing) >= 5
    assert packing == sorted(packing)
    growth = [float(row["boundary_growth"]) for row in seams]
    assert growth[0] == 0
    assert growth == sorted(growth)
    assert (tmp_path / "t.svg").read_text().count("<circle") == len(rows)
    second = run(program, source, "--seams", "needed", "--effort", "fast", "--trade-off", table, "--point", "1")
    assert second["boundary_growth"] == pytest.approx(growth[1], abs=1e-6)


@pytest.mark.parametrize(
    "options",
    [
        ("--effort", "best"),
        ("--seams", "none", "--seam-cost", "1"),
        ("--seams", "needed", "--effort", "great"),
        ("--seams", "needed", "--point", "1"),
        ("--seams", "needed", "--trade-off", "table.txt"),
        ("--seams", "needed", "--max-boundary-growth", "-1"),
    ],
)
def test_what_does_not_fit_is_refused(program, source, options):
    program.refused(2, source, "-o", source.parent / "out.obj", *options)


def test_what_cannot_be_had_together_is_named(program, source):
    options = ("--seams", "needed", "--max-distortion", "1.00001", "--max-boundary-growth", "0.05")
    told = program.refused(4, source, "-o", source.parent / "out.obj", *options)
    assert "boundary growth of 0.05" in str(told)
    assert run(program, source, *options, "--best-effort")["bound_met"] is False
