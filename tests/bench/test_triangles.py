"""Polygons as triangles: the least distortion of all ways to divide them, whatever corner they start with."""

import itertools

import check_atlas
import pytest
import triangles


def polygon(tmp_path, positions, uvs):
    lines = [f"v {x} {y} {z}" for x, y, z in positions] + [f"vt {u} {v}" for u, v in uvs]
    lines.append("f " + " ".join(f"{k}/{k}" for k in range(1, len(positions) + 1)))
    (tmp_path / "a.obj").write_text("\n".join(lines) + "\n")
    return check_atlas.read_obj(tmp_path / "a.obj")


# A triangle with corners in the middle of its sides: most fans hold a triangle that is flat in space.
DIVIDED = [(0, 0), (1, 0), (2, 0), (3, 0), (2, 1), (0, 3), (0, 1.5)]


@pytest.mark.parametrize("start", range(len(DIVIDED)))
@pytest.mark.parametrize("count", [4, 7])
def test_corners_in_the_middle_of_sides_cost_nothing(tmp_path, start, count):
    corners = DIVIDED if count == 7 else [(0, 0), (1, 0), (3, 0), (0, 3)]
    corners = corners[start % count :] + corners[: start % count]
    bulging = [(x, y - 0.01 * (y == 0 and 0 < x < 3)) for x, y in corners]  # as reduced distortion leaves them
    obj = polygon(tmp_path, [(x, y, 0) for x, y in corners], bulging)
    found = triangles.least_energy_triangles(obj)
    assert len(found) == count - 2
    assert triangles.distortion(obj, found)[0] == pytest.approx(1, abs=2e-3)


def test_least_of_all_ways(tmp_path):
    """A hexagon, against every triangulation of it."""
    positions = [(0, 0, 0), (2, 0, 0.3), (3, 1, 0), (2, 2, 1), (0, 2, 0), (-1, 1, 0.5)]
    uvs = [(0, 0), (1, 0), (1.7, 0.4), (1.2, 1.1), (0.1, 1.3), (-0.4, 0.5)]
    obj = polygon(tmp_path, positions, uvs)

    def ways(i, k):
        if k - i < 2:
            yield ()
        for j in range(i + 1, k):
            yield from (((i, j, k), *a, *b) for a, b in itertools.product(ways(i, j), ways(j, k)))

    every = list(ways(0, 5))
    assert len(every) == 14
    found = triangles.least_energy_triangles(obj)
    double_area, sliver, _, det = triangles.jacobians(obj, triangles.fan_triangles(obj.offsets)[0])
    scale2 = double_area.sum() / abs(det * double_area).sum()
    least = min(triangles.energies(obj, check_atlas.np.array(way), scale2).sum() for way in every)
    assert triangles.energies(obj, found, scale2).sum() == pytest.approx(least)
    assert not sliver.any()


def test_corners_of_a_polygon_come_in_its_sense(tmp_path):
    obj = polygon(tmp_path, [(x, y, 0) for x, y in DIVIDED], DIVIDED)
    found = triangles.least_energy_triangles(obj)
    assert (triangles.jacobians(obj, found)[3] > 0).all()
