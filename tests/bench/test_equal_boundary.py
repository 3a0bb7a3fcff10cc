"""The summary of equal boundary: what is compared with what, and that its verdicts can fail."""

import math

from equal_boundary import BUDGETS, File, Point, line, summary


def file_with(e_d, random, rectangles=1.02, there=1.01, **changed):
    points = {growth: Point(growth, e_d, 2, random) for growth in BUDGETS}
    return File("disk/a", 1.03, 1.05, points, Point(0.7, rectangles), Point(0.6, there), **changed)


def verdicts(files):
    return [text.rsplit(": ", 1)[1] for text in summary(files) if "against" in text]


def test_the_mean_of_all_draws_is_what_chance_comes_to():
    lines = summary([file_with(1.03, [1.04, 1.02]), file_with(1.01, [1.03])])
    assert "beside random necks, as many, 2 files: E_d 1.0200 against 1.0300, lower on 1: yes" in lines[2]
    assert "beside rectangles that add no more: no file has both" in lines[3]
    assert verdicts([file_with(1.01, [1.03])]) == ["yes"] * 4


def test_each_verdict_can_fail():
    assert verdicts([file_with(1.04, [1.03], there=1.03)]) == ["NO"] * 4
    short = file_with(1.04, [1.03])
    short.rectangles.growth = 0.15
    assert verdicts([short]) == ["NO", "NO", "NO", "NO", "NO", "yes"]


def test_files_without_a_cut_or_a_result_are_not_compared():
    uncut = file_with(1.05, [])
    for point in uncut.points.values():
        point.cuts = 0
    uncut.rectangles = Point(reason="exit 4: no")
    assert "no file has both" in summary([uncut])[2]
    assert "exit 4" in line(uncut)
    assert uncut.reasons == ["exit 4: no"]
    assert math.isnan(Point().by_chance)


def test_hopeless_inputs_are_left_out():
    hopeless = file_with(1.04, [1.03])
    hopeless.e_d_in = 3.0
    assert summary([hopeless, file_with(1.01, [1.03])])[0].startswith("2 files, 1 with E_d in < 1.2")
