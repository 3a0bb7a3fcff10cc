"""Writes an atlas of many charts: four of five have 2 to 8 triangles, the others are round, every second of those curved. With BORDER all
are flat and smooth, with so many vertices along their borders; with `triangles` each is one triangle.

usage: many_charts.py CHARTS OUT.obj [BORDER|triangles]     then ./dev bench --profile --meshes OUT.obj, or build/atlas-refine OUT.obj -o ...
"""

import math
import random
import sys
from pathlib import Path

FILLED = 0.5  # of the box, before: charts stand in rows


def polygon(rng):
    """A fan of 2 to 8 triangles around its first corner, flat."""
    count = rng.randint(4, 10)
    size, flat = math.exp(rng.gauss(0, 0.5)), rng.uniform(0.5, 1)
    turns = [2 * math.pi * (k + rng.uniform(-0.2, 0.2)) / count for k in range(count)]
    points = [(size * math.cos(a), flat * size * math.sin(a), 0.0) for a in turns]
    return points, [(0, k, k + 1) for k in range(1, count - 1)]


def disk(rng, bulge):
    rings, sides, size = rng.choice([2, 3, 4, 5]), rng.choice([9, 12, 16, 20]), math.exp(rng.gauss(1, 0.5))
    return wavy(rng, rings, sides, size, bulge)


def triangle(rng):
    """No lower than a fifth of its longest side."""
    size, apex, height = rng.uniform(0.4, 1), rng.uniform(0, 1), rng.uniform(0.2, 1)
    return [(0.0, 0.0, 0.0), (size, 0.0, 0.0), (size * apex, size * height, 0.0)], [(0, 1, 2)]


def smooth(rng, border):
    return wavy(rng, max(3, border // 40), border, math.exp(rng.gauss(1, 0.4)), 0)


def wavy(rng, rings, sides, size, bulge):
    """Rings around a point, the border wavy."""
    waves, phase = rng.uniform(0.05, 0.3), rng.uniform(0, 2 * math.pi)
    points = [(0.0, 0.0, 0.0)]
    for ring in range(1, rings + 1):
        for side in range(sides):
            a, along = 2 * math.pi * side / sides, ring / rings
            r = size * along * (1 + waves * along * math.sin(3 * a + phase))
            points.append((r * math.cos(a), r * math.sin(a), bulge * size * math.cos(2 * along)))
    triangles = []
    for side in range(sides):
        after = (side + 1) % sides
        triangles.append((0, 1 + side, 1 + after))
        for first in range(1, 1 + (rings - 1) * sides, sides):
            a, b, c, d = first + side, first + sides + side, first + sides + after, first + after
            triangles += [(a, b, c), (a, c, d)]
    return points, triangles


def charts(count, kind=None, seed=1):
    rng = random.Random(seed)
    if kind == "triangles":
        return [triangle(rng) for _ in range(count)]
    if kind:
        border = int(kind)
        return [smooth(rng, border) for _ in range(count)]
    return [disk(rng, 0.6 * (k % 2)) if k % 5 == 0 else polygon(rng) for k in range(count)]


def in_rows(made):
    """Where each chart's min corner goes, and the side of the square that holds all."""
    sizes = [[max(p[k] for p in points) - min(p[k] for p in points) for k in (0, 1)] for points, _ in made]
    side = math.sqrt(sum(width * height for width, height in sizes) / FILLED)
    places, x, y, height = {}, 0.0, 0.0, 0.0
    for k in sorted(range(len(made)), key=lambda k: -sizes[k][1]):
        if x + sizes[k][0] > side:
            x, y, height = 0.0, y + 1.02 * height, 0.0
        places[k] = (x, y)
        x, height = x + 1.02 * sizes[k][0], max(height, sizes[k][1])
    return places, max(side, y + height)


def write(count, path, kind=None):
    made = charts(count, kind)
    places, side = in_rows(made)
    positions, uvs, faces, first = [], [], [], 1
    for k, (points, triangles) in enumerate(made):
        corner = [min(p[axis] for p in points) - places[k][axis] for axis in (0, 1)]
        for x, y, z in points:
            positions.append(f"v {x - corner[0]:.6f} {y - corner[1]:.6f} {z:.6f}")
            uvs.append(f"vt {(x - corner[0]) / side:.9f} {(y - corner[1]) / side:.9f}")
        faces += ["f " + " ".join(f"{first + v}/{first + v}" for v in triangle) for triangle in triangles]
        first += len(points)
    Path(path).write_text("\n".join([*positions, *uvs, *faces, ""]))


if __name__ == "__main__":
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    write(int(sys.argv[1]), *sys.argv[2:])
