"""Bad input and bad usage: one clear line, the right exit code, nothing written, an old output left as it was."""

import gzip
import json
import os
import re

import pytest
from conftest import REPOSITORY
from obj_shapes import grid

QUAD = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
FACE = "f 1/1 2/2 3/3 4/4\n"

BAD_FILES = {
    "empty": ("", "is empty"),
    "no faces": (QUAD, "has no faces"),
    "binary": ("\x88\r\n\x1a\n\x00\x01\x02", "has no faces"),
    "no UVs": (QUAD + "f 1 2 3 4\n", "has no UVs"),
    "no UVs, normals": (QUAD + "vn 0 0 1\nf 1//1 2//1 3//1\n", "has no UVs"),
    "no face with UVs at all corners": (QUAD + "f 1/1 2/2 3\n", "has no UVs: no face has a vt index at each of its corners"),
    "NaN position": (QUAD.replace("v 1 1 0", "v 1 nan 0") + FACE, "line 3: a vertex position that is not finite"),
    "infinite position": (QUAD.replace("v 1 1 0", "v 1 -inf 0") + FACE, "line 3: a vertex position that is not finite"),
    "huge position": (QUAD.replace("v 1 1 0", "v 1 1e999 0") + FACE, "line 3: a vertex position that is not finite"),
    "NaN UV": (QUAD.replace("vt 1 0", "vt NaN 0") + FACE, "line 6: a UV that is not finite"),
    "infinite UV": (QUAD.replace("vt 1 0", "vt 1 inf") + FACE, "line 6: a UV that is not finite"),
    "text for a number": (QUAD.replace("v 1 1 0", "v 1 one 0") + FACE, "line 3: 'one' is not a number"),
    "no number of a Windows program": (
        QUAD.replace("vt 1 0", "vt 1.#QNAN 0") + FACE,
        "line 6: a UV that is not finite: '1.#QNAN 0'",
    ),
    "decimal comma": (QUAD.replace("vt 1 0", "vt 1,0 0") + FACE, "line 6: '1,0' is not a number"),
    "short position": (QUAD.replace("v 1 1 0", "v 1 1") + FACE, "line 3: a vertex position with too few numbers"),
    "vt without numbers": (QUAD.replace("vt 1 0", "vt") + FACE, "line 6: a vt record without a number"),
    "vertex out of range": (QUAD + "f 1/1 2/2 5/3\n", "line 9: face 0: vertex 5 is out of range"),
    "UV out of range": (QUAD + "f 1/1 2/2 3/5\n", "line 9: face 0: UV index 5 is out of range"),
    "index zero": (QUAD + "f 0/1 2/2 3/3\n", "line 9: index out of range in '0/1'"),
    "negative out of range": (QUAD + "f -5/1 2/2 3/3\n", "line 9: index out of range in '-5/1'"),
    "enormous index": (QUAD + "f 1/1 2/2 99999999999999999999/3\n", "line 9: index out of range"),
    "garbage corner": (QUAD + "f 1/1 2/2 x/3\n", "line 9: 'x/3' is not a face corner"),
    "fractional corner": (QUAD + "f 1/1 2/2 3.5/3\n", "line 9: '3.5/3' is not a face corner"),
    "only two corners": (QUAD + "f 1/1 2/2\nf\n", "has no faces of three different vertices"),
    "only two vertices": (QUAD + "f 1/1 2/2 1/3\n", "has no faces of three different vertices"),
    "only a keyhole": (QUAD + "f 1/1 2/2 3/3 1/1 4/4\n", "has no faces with UVs that come to each of their vertices once"),
    "face left out before the bad one": (QUAD + "f 1 2 3\nf 1/1 2/2 9/3\n", "line 10: face 1: vertex 9"),
    "cut before the faces": (grid(4)[: grid(4).index("f ")], "has no faces"),
    "line numbers after continuations": (QUAD + "f 1/1 \\\n2/2 \\\n3/3\nf 1/1 2/2 x/3\n", "line 12: 'x/3'"),
    "line numbers in a CRLF file": ((QUAD + "f 1/1 2/2 x/3\n").replace("\n", "\r\n"), "line 9: 'x/3'"),
    "line numbers in a CR file": ((QUAD + "f 1/1 2/2 x/3\n").replace("\n", "\r"), "line 9: 'x/3'"),
}


@pytest.fixture
def old_output(tmp_path):
    path = tmp_path / "out.obj"
    path.write_text("the old file")
    yield path
    assert path.read_text() == "the old file"
    assert {p.name for p in tmp_path.iterdir()} <= {"in.obj", "out.obj", "folder"}


@pytest.fixture
def good(tmp_path):
    path = tmp_path / "in.obj"
    path.write_text(grid(4, 30))
    return path


@pytest.mark.parametrize("case", BAD_FILES)
@pytest.mark.parametrize("job", ["refine", "measure"])
def test_file_that_cannot_be_used(program, tmp_path, old_output, case, job):
    text, expected = BAD_FILES[case]
    path = tmp_path / "in.obj"
    path.write_bytes(text.encode("latin-1"))
    message = program.refused(3, path, "-o", old_output) if job == "refine" else program.refused(3, "measure", path)
    assert message.startswith(f"atlas-refine: {path}: ")
    assert expected in message


@pytest.mark.parametrize("job", ["refine", "measure"])
def test_missing_file_and_folder(program, tmp_path, old_output, job):
    (tmp_path / "folder").mkdir()
    for name, expected in (("nothing.obj", "does not exist"), ("folder", "is a directory")):
        arguments = [tmp_path / name, "-o", old_output] if job == "refine" else ["measure", tmp_path / name]
        assert program.refused(3, *arguments) == f"atlas-refine: {tmp_path / name}: " + (
            expected if name != "folder" else "is a directory, not an OBJ file"
        )


FOREIGN_FILES = {
    "glTF": (b'{"asset":{"version":"2.0"},"meshes":[]}', "a glTF file"),
    "JSON": (b'\n{"v": 1}', "a JSON file"),
    "GLB": (b"glTF\x02" + bytes(60), "a binary glTF (GLB) file"),
    "PLY": (b"ply\nformat ascii 1.0\nelement vertex 3\n", "a PLY file"),
    "gzip": (gzip.compress((QUAD + FACE).encode()), "a gzip file"),
    "UTF-16": ((QUAD + FACE).encode("utf-16"), "a UTF-16 file"),
    "UTF-16 without a mark": ((QUAD + FACE).encode("utf-16-le"), "a UTF-16 file"),
    "big-endian UTF-16": ((QUAD + FACE).encode("utf-16-be"), "a UTF-16 file"),
    "binary FBX": (b"Kaydara FBX Binary  \x00\x1a\x00" + bytes(40), "an FBX file"),
    "ASCII FBX": (b"; FBX 7.3.0 project file\nFBXHeaderExtension:  {\n}\n", "an FBX file"),
    "binary STL": (b"solid by name only".ljust(80) + b"\x02\0\0\0" + bytes(100), "an STL file"),
    "ASCII STL": (b"solid cube\n facet normal 0 0 1\n  outer loop\n", "an STL file"),
    "ASCII USD": (b"#usda 1.0\n(\n)\n", "a USD file"),
    "USD crate": (b"PXR-USDC" + bytes(40), "a USD file"),
    "USDZ": (b"PK\x03\x04" + bytes(26) + b"model.usdc", "a USD file"),
    "PNG": (b"\x89PNG\r\n\x1a\n\x00\x01\x02", "a PNG image"),
    "xz": (b"\xfd7zXZ\x00" + bytes(30), "an xz file"),
    "OFF": (b"OFF\n8 6 0\n0 0 0\n", "an OFF file"),
    "HTML": (b"\n<!DOCTYPE html>\n<html><body>404</body></html>\n", "an HTML page"),
    "Git LFS": (
        b"version https://git-lfs.github.com/spec/v1\noid sha256:0\n",
        "a pointer of Git LFS, whose file is to be fetched with git lfs pull",
    ),
    "zip": (b"PK\x03\x04" + bytes(26) + b"model.obj", "a zip file"),
    "COLLADA": (b'<?xml version="1.0"?>\n<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema">', "a COLLADA file"),
}


@pytest.mark.parametrize("case", FOREIGN_FILES)
def test_file_of_another_format_is_named_for_what_it_is(program, tmp_path, old_output, case):
    content, kind = FOREIGN_FILES[case]
    path = tmp_path / "in.obj"
    path.write_bytes(content)
    assert program.refused(3, path, "-o", old_output) == f"atlas-refine: {path}: is {kind}, not an OBJ file"


@pytest.mark.parametrize("name", ["out.glb", "out.ply", "out.obj.gz", "out"])
def test_output_of_an_unknown_format_is_refused_before_anything_is_read(program, tmp_path, name):
    message = program.refused(2, tmp_path / "not_there.obj", "-o", tmp_path / name)
    assert message == f"atlas-refine: {tmp_path / name}: has an unknown format; OBJ files can be written, NAME.obj"
    assert not any(tmp_path.iterdir())


def test_a_face_is_named_as_in_its_file(program, tmp_path):
    path = tmp_path / "in.obj"
    path.write_text(QUAD + "f 1 2 3\nf 1/1 2/2 3/3\nf 1/1 3/3 3/3 4/1\n")
    run = program("measure", path)
    assert run.returncode == 1
    assert b"no: face 2 of chart 0 has no area in the UV map" in run.stdout
    assert b"warning: 1 face has corners without UVs and is left out (line 9)" in run.stdout
    assert json.loads(program("measure", path, "--json").stdout)["validity"]["face"] == 2


RECTANGLES = ["--seams", "rectangles"]
BAD_OPTIONS = [
    (["--pe-bound", "0"], "--pe-bound"),
    (["--pe-bound", "1"], "--pe-bound"),
    (["--pe-bound", "1.2"], "--pe-bound"),
    (["--pe-bound", "-0.5"], "--pe-bound"),
    (["--pe-bound", "nan"], "--pe-bound"),
    (["--pe-bound", "much"], "--pe-bound"),
    (["--pe-bound", "0.8x"], "--pe-bound"),
    (["--pe-bound", ""], "--pe-bound"),
    (["--pe-bound"], "--pe-bound"),
    (["--pe-bound", "0.7", "--pe-bound", "0.8"], "--pe-bound"),
    (["--unknown"], "--unknown"),
    (["--unknown", "3"], "--unknown"),
    (["-x"], "-x"),
    (["another.obj"], "out.obj: is not a folder"),
    (["in.obj"], "in.obj: a second file of this name"),
    (["folder/"], "folder/: is not the name of a file"),
    (["--seams", "Rectangles"], "--seams"),
    (["--seams", ""], "--seams"),
    (["--sigma", "0.004"], "--sigma: needs --seams rectangles"),
    (["--candidates", "500"], "--candidates: needs --seams rectangles"),
    (["--omega", "0.1", "--seams", "none"], "--omega: needs --seams rectangles"),
    (["--until-input"], "--until-input: needs --seams rectangles"),
    (["--until-input=1", *RECTANGLES], "--until-input"),
    (["--sigma", "-0.004", *RECTANGLES], "--sigma"),
    (["--sigma", "0", *RECTANGLES], "--sigma"),
    (["--sigma", "0.2", *RECTANGLES], "--sigma"),
    (["--sigma", "nan", *RECTANGLES], "--sigma"),
    (["--candidates", "0", *RECTANGLES], "--candidates"),
    (["--candidates", "-5", *RECTANGLES], "--candidates"),
    (["--candidates", "1e3", *RECTANGLES], "--candidates"),
    (["--candidates", "1000001", *RECTANGLES], "--candidates"),
    (["--omega", "1.01", *RECTANGLES], "--omega"),
    (["--omega", "-0.1", *RECTANGLES], "--omega"),
    (["--reference", "uv"], "--reference"),
    (["--importance"], "--importance"),
    (["--aspect", "round"], "--aspect"),
    (["--aspect", "2:0"], "--aspect"),
    (["--aspect", "-2:1"], "--aspect"),
    (["--aspect", "2:1:1"], "--aspect"),
    (["--aspect", "1:101"], "--aspect"),
    (["--aspect", "101:1"], "--aspect"),
    (["--gap", "-0.1"], "--gap"),
    (["--gap", "0.5"], "--gap"),
    (["--gap-px", "4"], "--gap-px"),
    (["--texture-size", "1024"], "--texture-size"),
    (["--gap-px", "4", "--texture-size", "0"], "--texture-size"),
    (["--gap-px", "4", "--texture-size", "8"], "--gap-px"),
    (["--gap-px", "4", "--texture-size", "1024", "--gap", "0.01"], "--gap-px"),
    (["--max-distortion", "0.5"], "--max-distortion"),
    (["--max-stretch", "0.5"], "--max-stretch"),
    (["--density", "none"], "--density"),
    (["--seed", "-1"], "--seed"),
    (["--seed", "1.5"], "--seed"),
    (["--threads", "-1"], "--threads"),
    (["--best-effort=3"], "--best-effort"),
]


@pytest.mark.parametrize(("options", "thing"), BAD_OPTIONS, ids=lambda value: " ".join(value) if isinstance(value, list) else "")
def test_option_that_cannot_be_understood(program, good, old_output, options, thing):
    assert thing in program.refused(2, good, "-o", old_output, *options)


@pytest.mark.parametrize(
    "arguments", [[], ["-o", "out.obj"], ["measure"], ["measure", "a.obj", "b.obj"], ["measure", "--gap", "1"]]
)
def test_missing_or_surplus_arguments(program, arguments):
    program.refused(2, *arguments)


def test_missing_output(program, good):
    assert "--output" in program.refused(2, good)


def test_output_folder_that_does_not_exist(program, tmp_path, good, old_output):
    missing = tmp_path / "missing"
    assert "does not exist" in program.refused(2, good, "-o", missing / "out.obj")
    assert "does not exist" in program.refused(2, good, "-o", old_output, "--report", missing / "r.json")
    assert "does not exist" in program.refused(2, good, "-o", old_output, "--svg", missing / "pictures")


def test_output_that_is_no_file(program, tmp_path, good, old_output):
    (tmp_path / "folder").mkdir()
    program.refused(2, good, "-o", tmp_path / "folder")
    program.refused(2, good, "-o", "/dev/null")
    program.refused(2, good, "-o", "")
    program.refused(2, good, "-o", old_output, "--report", old_output)
    program.refused(2, good, "-o", old_output, "--report", good)
    program.refused(2, good, "-o", old_output, "--svg", good)


@pytest.mark.skipif(os.geteuid() == 0, reason="root may write everywhere")
def test_folder_without_permission(program, tmp_path, good):
    folder = tmp_path / "folder"
    folder.mkdir(mode=0o500)
    program.refused(2, good, "-o", folder / "out.obj")


BAD_IMPORTANCE = {
    "1 1\n1": "line 2: ends after 3 numbers, there are 16 faces",
    "": "line 1: ends after 0 numbers, there are 16 faces",
    "1\n" * 17: "line 17: more numbers than faces, there are 16",
    "1\n2 much\n": "line 2: 'much' is not a number",
    "1\r\n2\r\n1,5\r\n": "line 3: '1,5' is not a number",
    "1\nnan": "line 2: 'nan' is not a number",
    "1\ninf": "line 2: 'inf' is not a number",
    "1\n1e400": "line 2: '1e400' is not a number",
    "1\n\n0 1": "line 3: an importance must be positive, not '0'",
    "1 -2": "line 1: an importance must be positive, not '-2'",
}


@pytest.mark.parametrize("text", BAD_IMPORTANCE)
def test_importance_that_cannot_be_used(program, good, tmp_path_factory, old_output, text):
    path = tmp_path_factory.mktemp("importance") / "weights.txt"
    path.write_bytes(text.encode())
    message = program.refused(3, good, "-o", old_output, "--importance", path)
    assert message == f"atlas-refine: {path}: {BAD_IMPORTANCE[text]}"


@pytest.mark.parametrize("option", ["--keep-shape", "--locked"])
def test_flags_that_cannot_be_used(program, good, tmp_path_factory, old_output, option):
    folder = tmp_path_factory.mktemp("flags")
    path = folder / "flags.txt"
    for text, message in {
        "1 0.5": "line 1: a flag must be 0 or 1, not '0.5'",
        "1\n0\n": "line 3: ends after 2 numbers, there are 16 faces",
    }.items():
        path.write_text(text)
        assert program.refused(3, good, "-o", old_output, option, path) == f"atlas-refine: {path}: {message}"
    assert "does not exist" in program.refused(3, good, "-o", old_output, option, folder / "nothing")


def test_no_turns_and_aligned_axes_exclude_each_other(program, good, old_output):
    assert "--align-axes" in program.refused(2, good, "-o", old_output, "--rotate", "none", "--align-axes")
    assert "--rotate" in program.refused(2, good, "-o", old_output, "--rotate", "45")


def test_importance_that_is_not_there(program, tmp_path, good, old_output):
    missing = program.refused(3, good, "-o", old_output, "--importance", tmp_path / "nothing")
    assert missing == f"atlas-refine: {tmp_path / 'nothing'}: does not exist"
    assert "is a directory" in program.refused(3, good, "-o", old_output, "--importance", tmp_path)


def test_bound_out_of_reach_writes_nothing(program, tmp_path, old_output):
    """A triangle fills half of any box."""
    path = tmp_path / "in.obj"
    path.write_text(QUAD + "f 1/1 2/2 3/3\n")
    message = program.refused(4, path, "-o", old_output, "--report", tmp_path / "r.json")
    assert "0.5" in message


CUT_OPTIONS = ("--seams", "--sigma", "--candidates", "--omega", "--until-input", "--reference", "--importance")


def test_help_and_version(program):
    for arguments in (["--help"], ["measure", "--help"], ["--version"]):
        run = program(*arguments)
        assert (run.returncode, run.stderr) == (0, b"")
    assert program("--version").stdout.startswith(b"atlas-refine ")
    for option in (
        "--pe-bound",
        "--gap-px",
        "--texture-size",
        "--max-distortion",
        "--max-stretch",
        "--best-effort",
        "--svg",
        "--report",
        *CUT_OPTIONS,
    ):
        assert option.encode() in program("--help").stdout


@pytest.mark.parametrize("document", ["README.md", "docs/command_line.md"])
def test_the_documents_list_every_option(program, document):
    helps = b"".join(program(*arguments).stdout for arguments in (["--help"], ["measure", "--help"])).decode()
    known = set(re.findall(r"^  (?:-\w,)?(--[a-z-]+)", helps, re.MULTILINE))
    assert {"--help", "--output", "--relax", "--json"} <= known
    cells = re.findall(r"^\| (`-.*?) \| ", (REPOSITORY / document).read_text(), re.MULTILINE)
    listed = {name for cell in cells for name in re.findall(r"(?<![\w-])--[a-z-]+", cell)}
    everywhere = {"--help", "--version", "--json", "--output"}  # README: on the line above the table or as -o
    assert listed | (everywhere if document == "README.md" else set()) == known


def test_every_exit_code_is_in_the_documents():
    code = re.compile(r"\bexit_\w+ = (\d+)")
    cli = REPOSITORY / "native" / "cli"
    codes = {int(number) for name in ("main.cpp", "interrupt.h") for number in code.findall((cli / name).read_text())}
    assert codes == {0, 1, 2, 3, 4, 130}
    table = (REPOSITORY / "docs" / "command_line.md").read_text()
    assert {int(number) for number in re.findall(r"^\| (\d+) \|", table, re.MULTILINE)} == codes
    paragraph = re.search(r"^Exit codes: (.*?)\n\n", (REPOSITORY / "README.md").read_text(), re.MULTILINE | re.DOTALL).group(1)
    assert {int(number) for number in re.findall(r"(?:^|;\s)(\d+) ", paragraph)} == codes
