"""The table of --blender, from rows as beside_pack_islands.py prints them."""

import in_blender


def way(use, e_d, valid=True, seconds=1.0, gap_px=4.0):
    return {"use": use, "e_d": e_d, "charts": 3, "gap_px": gap_px, "border_px": 4.0, "valid": valid, "seconds": seconds}


def row(ours, **more):
    found = {"file": "atlas-clean/one", "triangles": 200, "input": way(0.4, 1.2), "pack islands": way(0.6, 1.2, seconds=9.0)}
    return {**found, "atlas refine": ours, **more}


def test_a_row_has_all_three_and_fits_its_header():
    text = in_blender.line(row(way(0.8, 1.1)))
    assert len(text) == len(in_blender.header())
    assert [word for word in text.split() if word.startswith("0.")] == ["0.400", "0.600", "0.800"]
    assert len(in_blender.line(row(way(0.8, 1.1, gap_px=None)))) == len(text)


def test_what_is_not_valid_or_misses_the_bound_does_not_count():
    failed = {"file": "atlas-clean/two", "why not": "crashed"}
    rows = [row(way(0.8, 1.1)), row(way(0.79, 1.1)), row(way(0.9, 1.3)), row(way(0.9, 1.0, valid=False)), failed]
    assert [in_blender.holds(each, 0.8) for each in rows] == [True, False, True, False, False]
    assert in_blender.summary(rows, 0.8)[0] == "atlas refine valid and at the bound: 2 of 5"
    assert in_blender.summary(rows, 0.8)[-1] == "atlas refine: more use on 4, no more E_d on 3, less time on 4 of 4"
    assert in_blender.line(failed).endswith("crashed")


def test_nothing_measured_is_no_table():
    assert in_blender.summary([{"file": "x", "why not": "crashed"}], 0.8) == ["no file has results"]
