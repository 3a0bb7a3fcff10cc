"""What the program writes: the input's bytes with new UVs, a report, a summary."""

import json
import os
import stat

import pytest
from obj_shapes import arc, box_efficiency, grid, records, uvs, without_uvs


def refine(program, tmp_path, text, *options, name="in.obj"):
    source, target = tmp_path / name, tmp_path / "out.obj"
    source.write_bytes(text.encode())
    run = program(source, "-o", target, *options)
    assert run.returncode == 0, run.stderr.decode()
    assert run.stderr == b""
    return target.read_bytes().decode(), run.stdout.decode()


def test_atlas_at_the_bound_comes_back_byte_for_byte(program, tmp_path):
    text = grid(4).replace("vt 0.25 0.25", "vt 2.50e-1\t.25  # a comment", 1) + "# the end, without a line end"
    result, told = refine(program, tmp_path, text)
    assert result == text
    assert told.startswith("unchanged")


@pytest.mark.parametrize("relative", [False, True])
@pytest.mark.parametrize("normals", [False, True])
@pytest.mark.parametrize("line_end", ["\n", "\r\n"])
def test_only_uv_records_change(program, tmp_path, relative, normals, line_end):
    text = grid(4, 30, relative=relative, normals=normals, line_end=line_end)
    result, _ = refine(program, tmp_path, text)
    assert without_uvs(result) == without_uvs(text)
    assert len(uvs(result)) == len(uvs(text))
    assert uvs(result) != uvs(text)
    assert box_efficiency(text) < 0.8 <= box_efficiency(result)


def test_uvs_are_shortest_round_trip_decimals(program, tmp_path):
    result, _ = refine(program, tmp_path, grid(4, 30, bump=0.2))
    for record in records(result, "vt"):
        for number in record.split()[1:]:
            assert len(number) <= len(repr(float(number))) + 1
    assert any(len(number) > 14 for record in records(result, "vt") for number in record.split()[1:])


def test_rare_syntax_is_kept(program, tmp_path):
    text = (
        "\ufeff# polygons, colours, continuations\r\n"
        "v 0 0 0 1 0.5 0.25\r\nv +1e0 0 0\r\nv 1 1 0 # corner\r\nv 0 1. 0\r\nv .5 1.5 0 1.0\r\n"
        "vt 0.5\r\nvt 1 0.5\r\nvt 0.5 1 0.125\r\n\tvt 0 \\\r\n 0.5  # fourth\r\nvt 0 1 0\r\nvt 7 7\r\n"
        "vn 0 0 1\r\n\r\n"
        "p 1 2\r\nl 1/1 2/2 -1/-1\r\ncstype bezier\r\nusemtl with spaces \\ and more\r\n"
        "  f  1/1/1 2/2/1 \\\r\n  3/3/1\t-2/-3/-1 #end\r\n"
        "f 4/4/1 3/3/1 5/5/1"
    )
    result, _ = refine(program, tmp_path, text, "--pe-bound", "0.9", "--best-effort")
    kept = [line for line in text.split("\r\n") if "vt" not in line and line != " 0.5  # fourth"]
    assert [line for line in result.split("\r\n") if "vt" not in line and not line.endswith("# fourth")] == kept
    assert "vt 7 7\r\n" in result
    assert len(records(result, "vt")) == 6


def test_forward_references_and_interleaved_blocks(program, tmp_path):
    blocks, corner = [], 1
    for k in range(3):
        blocks.append(f"o part{k}\n")
        quad = " ".join(f"{corner + i}/{corner + i}" for i in range(4))
        face = f"f {quad}\n"
        points = "".join(f"v {x + 2 * k} {y} 0\nvt {0.1 * x + 0.3 * k} {0.1 * y}\n" for x, y in ((0, 0), (1, 0), (1, 1), (0, 1)))
        blocks.append(face + points if k == 1 else points + face)
        corner += 4
    text = "".join(blocks)
    result, _ = refine(program, tmp_path, text)
    assert without_uvs(result) == without_uvs(text)


def test_file_names_with_spaces_and_other_scripts(program, tmp_path):
    folder = tmp_path / "Ünï cödé 図"
    folder.mkdir()
    refine(program, folder, grid(3, 30), "--report", folder / "bericht ä.json", name="my atlas é.obj")
    assert json.loads((folder / "bericht ä.json").read_text())["files"][0]["input"].endswith("my atlas é.obj")


def test_file_name_that_is_not_utf8(program, tmp_path):
    source = os.fsencode(tmp_path) + b"/\xff.obj"
    with open(source, "w") as file:
        file.write(grid(3))
    report = tmp_path / "r.json"
    assert program(source, "-o", tmp_path / "out.obj", "--report", report).returncode == 0
    json.loads(report.read_text())


def test_output_in_place(program, tmp_path):
    path = tmp_path / "a.obj"
    path.write_text(grid(4, 30))
    path.chmod(0o640)
    assert program(path, "-o", path).returncode == 0
    assert box_efficiency(path.read_text()) >= 0.8
    assert stat.S_IMODE(path.stat().st_mode) == 0o640
    assert [p.name for p in tmp_path.iterdir()] == ["a.obj"]


def test_output_through_a_link_keeps_the_link(program, tmp_path):
    source, target, link = tmp_path / "in.obj", tmp_path / "real.obj", tmp_path / "link.obj"
    source.write_text(grid(3))
    target.write_text("old")
    link.symlink_to(target)
    assert program(source, "-o", link).returncode == 0
    assert link.is_symlink()
    assert target.read_text() == source.read_text()


def test_report(program, tmp_path):
    report = tmp_path / "r.json"
    options = ["--seed", "7", "--gap-px", "2", "--texture-size", "1024", "--aspect", "2:1", "--pe-bound", "0.7"]
    refine(program, tmp_path, grid(4, 30), *options, "--best-effort", "--report", report)
    told = json.loads(report.read_text())
    assert told["program"] == "atlas-refine"
    assert told["version"].count(".") == 2
    assert told["options"]["seed"] == 7
    assert told["options"]["pe_bound"] == 0.7
    assert told["options"]["box_aspect"] == 2
    assert told["options"]["gap"] == {"value": 2 / 1024, "unit": "long_side"}
    assert told["options"]["seams"] == "none"
    assert told["options"]["rectangles"] is None
    assert told["files"] == [
        {
            "input": str(tmp_path / "in.obj"),
            "output": str(tmp_path / "out.obj"),
            "faces": 16,
            "added_faces": 0,
            "vertices": 25,
            "added_vertices": 0,
        }
    ]
    assert told["intervention"] in ("moved", "squeezed")
    assert told["before"]["pe"] == pytest.approx(box_efficiency(grid(4, 30)))
    assert told["after"]["gap_between"] is None
    assert told["added_seam_edges"] == 0
    assert told["added_seam_length"] == 0
    for key in ("bound_met", "price", "iterations", "charts", "repairs", "warnings", "timings", "gap"):
        assert key in told
    assert set(told["seconds"]) == {"read", "refine", "write"}
    assert told["profile"]["files"] > 0
    assert told["profile"]["phases"]["certificate"] > 0


def test_cut_is_told(program, tmp_path):
    """A C bends no further than its rectangles: what was added is in the file, the report and the summary."""
    report = tmp_path / "r.json"
    text = arc(12)
    result, told = refine(program, tmp_path, text, "--seams", "rectangles", "--candidates", "50", "--report", report)
    assert [line for line in result.splitlines() if line.startswith("v ")][: text.count("v ")] == records(text, "v")
    for word in ("cut: ", "seams BL", "charts", "added", "packed to", "align"):
        assert word in told
    written = json.loads(report.read_text())
    assert written["options"]["rectangles"] == {"sigma": 0.004, "candidates": 50, "omega": 0.1, "until_input": False}
    assert {"align", "layout", "reduce"} <= {stage["stage"] for stage in written["timings"]}
    assert written["rectangles"]["trails"] >= 0
    added = written["files"][0]
    assert len(records(result, "f")) == added["faces"] + added["added_faces"]
    assert len(records(result, "v")) == added["vertices"] + added["added_vertices"]
    before, after = written["before"], written["after"]
    assert after["boundary_length"] >= before["boundary_length"]


def test_cuts_along_edges_keep_everything_but_uvs(program, tmp_path):
    text, report = arc(12), tmp_path / "report.json"
    options = ("--seams", "rectangles", "--cut", "edges", "--pe-bound", "0.9", "--report", report)
    result, told = refine(program, tmp_path, text, *options)
    assert told.startswith("cut: ")
    for kind in ("v", "vn"):
        assert records(result, kind) == records(text, kind)
    vertices = [[[corner.split("/")[0] for corner in face.split()] for face in records(t, "f")] for t in (result, text)]
    assert vertices[0] == vertices[1]
    assert len(uvs(result)) > len(uvs(text))
    written = json.loads(report.read_text())
    assert written["options"]["cut"] == "edges"
    assert written["after"]["chart_count"] == len(written["pieces"]) > 1
    assert [file["added_faces"] for file in written["files"]] == [0]


@pytest.mark.parametrize("seams", ["none", "rectangles"])
def test_importance_is_read(program, tmp_path, seams):
    """A weight of 1 for all changes nothing; more for one half of the faces does."""
    options = ["--seams", seams, "--pe-bound", "0.9"]
    weights = tmp_path / "weights.txt"
    results = {}
    for name, values in {"without": None, "ones": [1] * 144, "half": [100] * 72 + [1] * 72}.items():
        if values:
            weights.write_text("\n".join(map(str, values)))
        more = ["--importance", weights] if values else []
        results[name] = refine(program, tmp_path, arc(12), *options, *more)[0]
    assert results["without"] == results["ones"] != results["half"]


def test_kept_and_locked_charts_are_read(program, tmp_path):
    """What is kept does not bend, what is locked does not move: alone in the file either says why the bound is missed."""
    flags = tmp_path / "flags.txt"
    flags.write_text("1\n" + "0\n" * 143)
    source, target = tmp_path / "in.obj", tmp_path / "out.obj"
    source.write_text(arc(12))
    for option, word in {"--keep-shape": "kept in its shape", "--locked": "the chart is locked"}.items():
        assert word in program.refused(4, source, "-o", target, "--pe-bound", "0.95", option, flags)
    assert program(source, "-o", target, "--pe-bound", "0.95").returncode == 0


def test_reference_is_read(program, tmp_path):
    text = arc(12).replace("vt 0.5 0.0", "vt 0.45 -0.02")
    surface, _ = refine(program, tmp_path, text, "--pe-bound", "0.9")
    own, _ = refine(program, tmp_path, text, "--pe-bound", "0.9", "--reference", "input")
    assert surface != own


def test_measure_prints_a_table_and_changes_nothing(program, tmp_path):
    path = tmp_path / "in.obj"
    path.write_text(grid(4, 30))
    run = program("measure", path)
    assert (run.returncode, run.stderr) == (0, b"")
    assert b"packing efficiency" in run.stdout
    assert b"yes" in run.stdout
    assert [p.name for p in tmp_path.iterdir()] == ["in.obj"]


def test_measure_json(program, tmp_path):
    path = tmp_path / "in.obj"
    path.write_text(grid(4, 30))
    told = json.loads(program("measure", path, "--json", "--aspect", "1:2").stdout)
    assert told["measures"]["pe"] == pytest.approx(box_efficiency(grid(4, 30)))
    # The square box is all of a texture of 1:2, in whose texels the sheet is twice as high as wide.
    assert told["measures"]["pe_fixed_aspect"] == pytest.approx(told["measures"]["pe"])
    assert told["measures"]["distortion"] > 1.2
    assert told["measures"]["chart_count"] == 1
    assert told["measures"]["gap_between"] is None
    assert told["validity"]["valid"] is True


@pytest.mark.parametrize("aspect", ["1:2", "square", "3:1"])
def test_measure_of_a_box_that_leaves_some_of_the_texture(program, tmp_path, aspect):
    """Whatever its shape, the texture is [0, 1]^2 times the longer side of the box."""
    path = tmp_path / "in.obj"
    corners = ("0 0", "2 0", "2 1", "0 1")
    path.write_text("".join(f"v {corner} 0\nvt {corner}\n" for corner in corners) + "f 1/1 2/2 3/3 4/4\n")
    told = json.loads(program("measure", path, "--json", "--aspect", aspect).stdout)["measures"]
    assert (told["box_width"], told["box_height"], told["pe"]) == pytest.approx((2, 1, 1))
    assert told["pe_fixed_aspect"] == pytest.approx(0.5)


def test_measure_says_what_is_not_valid_and_exits_with_1(program, tmp_path):
    path = tmp_path / "in.obj"
    path.write_text(grid(2).replace("vt 0.5 0.5\n", "vt 5.5 0.5\n"))
    run = program("measure", path, "--json")
    assert (run.returncode, run.stderr) == (1, b"")
    told = json.loads(run.stdout)["validity"]
    assert told["valid"] is False
    assert told["problem"]
    run = program("measure", path)
    assert (run.returncode, run.stderr) == (1, b"")
    assert b"packing efficiency" in run.stdout
    assert told["problem"].encode() in run.stdout


def test_pictures_are_drawn(program, tmp_path):
    refine(program, tmp_path, grid(4, 30), "--svg", tmp_path / "pictures")
    drawn = sorted((tmp_path / "pictures").glob("*.svg"))
    assert drawn
    assert all("<svg" in picture.read_text() for picture in drawn)
