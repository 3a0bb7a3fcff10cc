"""The atlas of many charts is valid and made as it says."""

import check_atlas
import many_charts


def test_four_of_five_charts_are_small_and_all_are_valid(tmp_path):
    path = tmp_path / "many.obj"
    many_charts.write(50, path)
    sizes = [len(triangles) for _, triangles in many_charts.charts(50)]
    assert sum(2 <= size <= 8 for size in sizes) == 40
    found = check_atlas.check(str(path), str(path), None, None, cuts=False)
    assert found["ok"], found["problems"]
    assert found["charts"] == 50
