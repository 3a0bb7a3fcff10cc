"""Small generated OBJ files for the tests of the program."""

import math


def grid(side=4, angle_deg=0.0, bump=0.0, relative=False, normals=False, line_end="\n"):
    """A square sheet of side x side quads in one chart; turned by `angle_deg` in UV space its PE falls to about one half."""
    n = side + 1
    c, s = math.cos(math.radians(angle_deg)), math.sin(math.radians(angle_deg))
    lines = ["# a sheet", "mtllib sheet.mtl", "o Sheet"]
    for j in range(n):
        for i in range(n):
            lines.append(f"v {i / side} {j / side} {bump * math.sin(3.0 * i / side) * math.sin(2.0 * j / side)}")
    for j in range(n):
        for i in range(n):
            u, v = i / side - 0.5, j / side - 0.5
            lines.append(f"vt {0.5 + 0.5 * (c * u - s * v):.17g} {0.5 + 0.5 * (s * u + c * v):.17g}")
    if normals:
        lines.append("vn 0 0 1")
    for j in range(side):
        lines += [f"g row {j}", f"usemtl material_{j % 2}", f"s {j % 3}"]
        for i in range(side):
            quad = [j * n + i, j * n + i + 1, (j + 1) * n + i + 1, (j + 1) * n + i]
            numbers = [k - n * n if relative else k + 1 for k in quad]
            tail = ("/-1" if relative else "/1") if normals else ""
            lines.append("f " + " ".join(f"{k}/{k}{tail}" for k in numbers))
    return line_end.join(lines) + line_end


def arc(side):
    """A C of side x side quads in one chart, flat in space: it fills half of its box until it is bent."""
    n = side + 1
    points = [(0.5 + 0.5 * i / side, math.radians(300) * j / side) for j in range(n) for i in range(n)]
    points = [(r * math.cos(a), r * math.sin(a)) for r, a in points]
    lines = [f"v {x} {y} 0" for x, y in points] + [f"vt {x} {y}" for x, y in points]
    quads = [(j * n + i + 1, j * n + i + 2, (j + 1) * n + i + 2, (j + 1) * n + i + 1) for j in range(side) for i in range(side)]
    lines += ["f " + " ".join(f"{k}/{k}" for k in quad) for quad in quads]
    return "\n".join(lines) + "\n"


def records(text, keyword):
    return [line for line in text.splitlines() if line.split()[:1] == [keyword]]


def without_uvs(text):
    """All lines but the vt records."""
    return [line for line in text.splitlines(keepends=True) if line.split()[:1] != ["vt"]]


def uvs(text):
    return [tuple(float(x) for x in line.split()[1:3]) for line in records(text, "vt")]


def box_efficiency(text):
    """PE of a file whose polygons are convex in UV space, by its own arithmetic."""
    points = uvs(text)
    area = 0.0
    for face in records(text, "f"):
        ring = []
        for corner in face.split()[1:]:
            k = int(corner.split("/")[1])
            ring.append(points[k - 1 if k > 0 else len(points) + k])
        area += 0.5 * sum(a[0] * b[1] - a[1] * b[0] for a, b in zip(ring, ring[1:] + ring[:1], strict=True))
    xs, ys = zip(*points, strict=True)
    return area / ((max(xs) - min(xs)) * (max(ys) - min(ys)))
