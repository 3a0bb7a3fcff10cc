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
    assert in_blender.summary([{"file": "x", "why not": "crashed"}], 0.8) == ["no file has results of both"]


def test_what_is_not_valid_is_marked():
    bad = {**row(way(0.8, 1.1)), "pack islands": way(0.6, 1.2, valid=False)}
    assert "0.600*" in in_blender.line(bad)
    assert in_blender.summary([bad, row(way(0.8, 1.1))], 0.8)[1] == "pack islands valid: 1 of 2"


def test_each_way_is_measured_by_itself(monkeypatch):
    def run_way(_blender, _path, asked, *_):
        crashed = {"why not": "nothing after 1800 s"}
        return crashed if asked == "pack islands" else {"triangles": 200, "input": way(0.4, 1.2), asked: way(0.8, 1.1)}

    monkeypatch.setattr(in_blender, "run_way", run_way)
    found = in_blender.measured(None, None, 0.8, {})
    assert found["atlas refine"]["use"] == 0.8
    assert found["why not"] == "pack islands: nothing after 1800 s"
    assert in_blender.holds(found, 0.8)
    assert in_blender.line({"file": "x", **found}).endswith("1800 s")
