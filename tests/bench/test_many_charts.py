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


def test_with_a_border_all_charts_have_as_many_vertices_along_it(tmp_path):
    path = tmp_path / "smooth.obj"
    many_charts.write(6, path, 80)
    found = check_atlas.check(str(path), str(path), None, None, cuts=False)
    assert found["ok"], found["problems"]
    assert found["charts"] == 6
    for points, triangles in many_charts.charts(6, 80):
        sides = [frozenset((t[k], t[(k + 1) % 3])) for t in triangles for k in range(3)]
        assert sum(sides.count(side) == 1 for side in set(sides)) == 80
        assert all(z == points[0][2] for _, _, z in points)


def test_each_chart_may_be_one_triangle(tmp_path):
    path = tmp_path / "triangles.obj"
    many_charts.write(60, path, "triangles")
    found = check_atlas.check(str(path), str(path), None, None, cuts=False)
    assert found["ok"], found["problems"]
    assert found["charts"] == 60
    assert all(len(triangles) == 1 for _, triangles in many_charts.charts(60, "triangles"))
