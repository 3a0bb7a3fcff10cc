"""What is said of charts names them by file, object and line: their numbers count over all files."""

import json

import pytest
from obj_shapes import grid, records

OPTIONS = ("--pe-bound", "0.5")


def line_of(text, face):
    """The line, from 1, of the f record with that number, from 0."""
    return [k for k, line in enumerate(text.splitlines(), 1) if line.startswith("f ")][face]


def flipped(text, vertex):
    """The sheet with one vertex inside its UVs moved beyond its neighbours."""
    lines = text.splitlines()
    at = [k for k, line in enumerate(lines) if line.startswith("vt ")][vertex]
    u, v = map(float, lines[at].split()[1:])
    lines[at] = f"vt {u + 0.3} {v + 0.3}"
    return "\n".join(lines) + "\n"


def without_area(count):
    """Triangles of their own, each with all of its UVs in one point: 3 vertices and 3 UVs each."""
    return "".join(
        f"o Dot {k}\nv {k} 3 0\nv {k + 1} 3 0\nv {k} 4 0\nvt {k} {k}\nvt {k} {k}\nvt {k} {k}\nf -3/-3 -2/-2 -1/-1\n"
        for k in range(count)
    )


@pytest.fixture
def files(tmp_path):
    """Two files; the second has a face without UVs first, a flipped vertex and charts without area."""
    one, other = tmp_path / "one.obj", tmp_path / "other.obj"
    one.write_text(grid(4))

    def write(dots):
        text = flipped(grid(4, 30), 12)
        text = text.replace("g row 0\n", "g row 0\nf 1 2 3\n", 1) + without_area(dots)
        other.write_text(text)
        return one, other, text

    return write


def told_of(program, tmp_path, inputs, *options):
    report = tmp_path / "report.json"
    run = program(*inputs, "-o", tmp_path / "out", "--report", report, *OPTIONS, *options)
    assert run.returncode == 0, run.stderr
    return json.loads(report.read_text()), run.stdout.decode()


def test_a_chart_that_is_mended_is_named_by_its_file(program, tmp_path, files):
    one, other, text = files(0)
    told, summary = told_of(program, tmp_path, (one, other))
    (repair,) = told["repairs"]
    first = min(repair["faces"]) - 16 + 1  # of the other file, whose first face is left out
    place = f"the first {other}: face {first} of 'Sheet', line {line_of(text, first)}"
    assert repair["text"].startswith(f"chart 1 ({len(repair['faces'])} faces, {place}): ")
    assert f"  repair: {repair['text']}\n" in summary


@pytest.mark.parametrize("dots", [1, 2, 9])
def test_charts_that_are_left_are_named_by_their_file(program, tmp_path, files, dots):
    one, other, text = files(dots)
    told, summary = told_of(program, tmp_path, (one, other))
    place = f"{other}: face 17 of 'Dot 0', line {line_of(text, 17)}"
    charts = {1: f"chart 2 ({place}): ", 2: f"charts 2, 3 (the first {place}): each ", 9: f"9 charts (the first {place}): each "}
    warning = f"{charts[dots]}has no area in the UV map; left as before, outside the atlas"
    assert warning in told["warnings"]
    assert f"  warning: {warning}\n" in summary


def test_a_chart_of_one_file_is_named_without_the_file(program, tmp_path):
    source, report = tmp_path / "in.obj", tmp_path / "report.json"
    text = grid(4) + without_area(1)
    source.write_text(text)
    assert program(source, "-o", tmp_path / "out.obj", "--report", report, *OPTIONS).returncode == 0
    left = f"chart 1 (face 16 of 'Dot 0', line {line_of(text, 16)}): has no area"
    assert any(warning.startswith(left) for warning in json.loads(report.read_text())["warnings"])


@pytest.mark.parametrize(("option", "wish"), [("--no-seam", "edges without seams"), ("--prefer-seam", "edges for seams")])
def test_pairs_that_are_no_edge_are_told(program, tmp_path, option, wish):
    source, edges, report = (tmp_path / name for name in ("in.obj", "edges.txt", "report.json"))
    source.write_text(grid(4, 30))
    for text, warning in {
        "0 1 5 0": None,
        "0 1\n0 6\n": f"{wish}: vertices 0 and 6 are no edge of a face; that pair counts for nothing",
        "0 1 7 3 0 6 2 2": f"{wish}: 3 pairs of vertices are no edge of a face, the first 7 and 3; they count for nothing",
    }.items():
        edges.write_text(text)
        assert program(source, "-o", tmp_path / "out.obj", "--report", report, option, edges, *OPTIONS).returncode == 0
        told = [line for line in json.loads(report.read_text())["warnings"] if "no edge" in line]
        assert told == ([warning] if warning else [])


def test_what_is_kept_on_another_chart_has_no_place_of_its_own(program, tmp_path):
    """Two sheets on each other stay so; a third that overlaps them does not."""
    source, report = tmp_path / "in.obj", tmp_path / "report.json"
    sheet = grid(4, relative=True)
    other = grid(3, 20, relative=True)
    for text, own in ((sheet + sheet + other, "other charts overlapped"), (sheet + other, "charts overlapped")):
        source.write_text(text)
        assert program(source, "-o", tmp_path / "out.obj", "--report", report, *OPTIONS).returncode == 0
        warnings = json.loads(report.read_text())["warnings"]
        assert len([line for line in warnings if line.startswith(own)]) == 1, warnings
    assert len(records(source.read_text(), "f")) == 25


@pytest.mark.parametrize(("count", "lines"), [(5, 5), (6, 1)])
def test_what_was_done_to_many_charts_is_one_line(program, tmp_path, count, lines):
    inputs = []
    for k in range(count):
        inputs.append(tmp_path / f"sheet{k}.obj")
        inputs[-1].write_text(flipped(grid(4, 30 * k), 12))
    told, summary = told_of(program, tmp_path, inputs, "--stacks", "separate")
    assert len(told["repairs"]) == count
    written = [line for line in summary.splitlines() if line.startswith("  repair: ")]
    assert len(written) == lines
    if lines == 1:
        faces = sum(len(repair["faces"]) for repair in told["repairs"])
        assert written[0].startswith(f"  repair: charts 0, 1, 2, 3, 4, 5 ({faces} faces, the first {inputs[0]}: ")
