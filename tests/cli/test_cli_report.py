"""docs/report.schema.json says field by field what the program writes: every field that is written is in it, and the reverse."""

import json
import re
from pathlib import Path

import pytest
from jsonschema import Draft202012Validator
from obj_shapes import arc, grid

SCHEMA = json.loads((Path(__file__).resolve().parents[2] / "docs" / "report.schema.json").read_text())
TRIANGLE = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n"
RECTANGLES = ["--seams", "rectangles", "--candidates", "20"]

#: What to refine, the options, and what the program does about it.
REPORTS = {
    "unchanged": ([grid(4)], [], "unchanged"),
    "moved": ([grid(4, 30)], [], "moved"),
    "squeezed": ([arc(12)], ["--gap", "0.002", "--aspect", "2:1", "--max-distortion", "9", "--max-stretch", "9"], "squeezed"),
    "cut": ([arc(12)], RECTANGLES, "cut"),
    "several files": ([grid(4, 30), arc(8)], [], "squeezed"),
    "several files, cut": ([arc(12), grid(4, 30)], RECTANGLES, "cut"),
    "bound missed": ([TRIANGLE], ["--pe-bound", "0.9", "--best-effort"], None),
}


def validator(definition=None):
    schema = SCHEMA if definition is None else {"$ref": f"#/$defs/{definition}", "$defs": SCHEMA["$defs"]}
    return Draft202012Validator(schema)


def objects(schema):
    """Every part of the schema that describes an object."""
    if isinstance(schema, dict):
        if schema.get("type") == "object":
            yield schema
        schema = list(schema.values())
    if isinstance(schema, list):
        for part in schema:
            yield from objects(part)


def report(program, folder, texts, *options):
    inputs = []
    for k, text in enumerate(texts):
        inputs.append(folder / f"{k}.obj")
        inputs[-1].write_text(text)
    run = program(*inputs, "-o", folder / ("out" if len(texts) > 1 else "out.obj"), "--report", folder / "r.json", *options)
    assert run.returncode == 0, run.stderr.decode()
    return json.loads((folder / "r.json").read_text()), run.stdout.decode()


def test_the_schema_describes_every_field_and_allows_no_other():
    Draft202012Validator.check_schema(SCHEMA)
    described = list(objects(SCHEMA))
    assert len(described) > 10
    for part in described:
        assert part["additionalProperties"] is False
        assert sorted(part["required"]) == sorted(part["properties"])
        assert part["description"]
        for name, field in part["properties"].items():
            assert field.get("description", "").endswith("."), name


@pytest.mark.parametrize("case", REPORTS)
def test_reports_hold_the_schema(program, tmp_path, case):
    texts, options, intervention = REPORTS[case]
    told, _ = report(program, tmp_path, texts, *options)
    validator().validate(told)
    assert intervention in (None, told["intervention"])
    assert told["bound_met"] is (case != "bound missed")
    assert [file["output"] for file in told["files"]] == [
        str(tmp_path / "out" / f"{k}.obj" if len(texts) > 1 else tmp_path / "out.obj") for k in range(len(texts))
    ]
    assert [chart["index"] for chart in told["charts"]] == list(range(told["before"]["chart_count"]))
    assert sum(chart["faces"] for chart in told["charts"]) == sum(file["faces"] for file in told["files"])


def test_distortion_of_nothing_is_none(program, tmp_path):
    told, summary = report(program, tmp_path, [re.sub("vt .*", "vt 0 0", grid(4))])
    validator().validate(told)
    assert told["after"]["chart_count"] == 0
    for when in ("before", "after"):
        assert {told[when][name] for name in ("distortion", "distortion_to_input", "stretch_99", "stretch_max")} == {None}
    assert "  E_d          - -> -\n" in summary


@pytest.mark.parametrize("damage", [("extra", 1), ("after", None), ("intervention", "bent"), ("iterations", 0.5)])
def test_the_schema_refuses_what_is_not_a_report(program, tmp_path, damage):
    told, _ = report(program, tmp_path, [grid(4)])
    told[damage[0]] = damage[1]
    assert not validator().is_valid(told)


def test_charts_and_pieces_carry_what_they_are(program, tmp_path):
    """A sheet of 1 x 1 and a C of five sixths of the ring between the radii 0.5 and 1, which is cut."""
    told, _ = report(program, tmp_path, [grid(4, 30), arc(12)], *RECTANGLES)
    sheet, ring = told["charts"]
    assert (sheet["faces"], ring["faces"]) == (16, 144)
    assert sheet["area"] == pytest.approx(1)
    assert 1.9 < ring["area"] < 1.97
    assert len(told["pieces"]) == told["after"]["chart_count"]
    assert {piece["chart"] for piece in told["pieces"]} == {0, 1}
    for chart in told["charts"]:
        parts = [piece["area"] for piece in told["pieces"] if piece["chart"] == chart["index"]]
        assert sum(parts) == pytest.approx(chart["area"])
    assert sum(piece["faces"] for piece in told["pieces"]) == sum(file["faces"] + file["added_faces"] for file in told["files"])
    assert all(piece["distortion"] >= 1 - 1e-12 and piece["stretch_max"] >= 1 for piece in told["pieces"])


def test_texel_density_is_told(program, tmp_path):
    """The sheet has half the C's scale. Charts that are only moved come to one density, or keep theirs."""
    told, _ = report(program, tmp_path, [grid(4), arc(8)], "--pe-bound", "0.4", "--density", "keep")
    assert told["intervention"] == "moved"
    before = [chart["density_before"] for chart in told["charts"]]
    assert before[1] / before[0] == pytest.approx(2)
    assert [chart["density_after"] for chart in told["charts"]] == pytest.approx(before)
    told, _ = report(program, tmp_path, [grid(4), arc(8)], "--pe-bound", "0.4")
    assert told["intervention"] == "moved"
    assert [chart["density_before"] for chart in told["charts"]] == pytest.approx(before)
    assert [chart["density_after"] for chart in told["charts"]] == pytest.approx([1, 1])


def test_why_it_ended_is_told(program, tmp_path):
    assert report(program, tmp_path, [grid(4)])[0]["ended"] == "not_run"
    assert report(program, tmp_path, [arc(12)])[0]["ended"] == "at_optimum"


def test_the_box_and_its_share_are_told(program, tmp_path):
    told, summary = report(program, tmp_path, [arc(12)])
    after = told["after"]
    assert after["unit_square_share"] == pytest.approx(after["pe"] * after["box_width"] * after["box_height"])
    box = f"{after['box_width']:.3f} x {after['box_height']:.3f}, {100 * after['unit_square_share']:.1f} % of the unit square"
    assert f"  box          {box}\n" in summary


def test_measure_holds_the_schema(program, tmp_path):
    path = tmp_path / "in.obj"
    path.write_text(grid(4, 30))
    validator("measured").validate(json.loads(program("measure", path, "--json").stdout))
    path.write_text(grid(2).replace("vt 0.5 0.5\n", "vt 5.5 0.5\n"))
    validator("measured").validate(json.loads(program("measure", path, "--json").stdout))
