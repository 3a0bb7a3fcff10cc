"""The summary of needed seams: what it says of files that keep their limits, and that its verdicts can fail."""

import pytest
from measure_file import Row
from needed import cell, summary


def row(seams, **changed):
    figures = {
        "valid": True, "met": True, "added_seams": 0, "bl_in": 1.0, "bl": 1.0, "e_d_in": 1.05, "e_d": 1.06, "cpu_seconds": 1.0,
    }  # fmt: skip
    return Row("disk", "a", "0.80 free", seams, **(figures | changed))


def rows_of(needed, loose):
    return [row("none"), row("rectangles", bl=2.0), row("needed", **needed), row("needed", **loose)]


def verdicts(files):
    return [line.rsplit(": ", 1)[1] for line in summary(files)[-4:]]


def test_limits_that_are_kept_with_few_seams():
    files = [rows_of({"bl": 1.2, "cpu_seconds": 3.0}, {"bl": 1.1}), rows_of({"bl": 1.2, "cpu_seconds": 5.0}, {})]
    lines = summary(files)
    assert lines[0] == "2 files, 2 with E_d in < 1.2"
    assert lines[1].startswith(
        "limit E_d in + 0: kept on 2 of 2; no seam on 0; growth mean 20.0%; time / squeeze median 4.0, 1 of 2"
    )
    assert "no seam on 1; growth mean 5.0%" in lines[2]
    assert verdicts(files) == ["yes"] * 4


@pytest.mark.parametrize(
    ("needed", "loose", "wrong"),
    [({"bl": 1.4}, {}, 0), ({"bl": 2.5}, {}, 1), ({"bl": 1.2}, {"bl": 1.05}, 2), ({"bl": 1.2}, {"bl": 1.2}, 3)],
)
def test_each_verdict_can_fail(needed, loose, wrong):
    assert verdicts([rows_of(needed, loose)])[wrong] == "NO"


def test_rectangles_that_miss_the_limit_are_told():
    files = [rows_of({"bl": 2.5}, {})]
    assert "by 0.0100" in summary(files)[4]
    files[0][1].e_d = files[0][1].e_d_in
    assert "miss" not in summary(files)[4]


def test_a_file_that_misses_its_limit_is_counted_and_says_why():
    missed = {"valid": False, "reason": "exit 4: no atlas within"}
    files = [rows_of({"bl": 1.2}, {}), rows_of(missed, missed)]
    assert "kept on 1 of 2" in summary(files)[1]
    assert "exit 4" in cell(files[1][2])
    assert summary([rows_of(missed, missed)])  # with nothing to take means of
