"""Include directions of native/ (LEVELS), libraries that stay in one place, and what else the structure promises."""

import json
import pathlib
import re
import statistics
import subprocess

import pytest

NATIVE = pathlib.Path(__file__).resolve().parents[1] / "native"
SOURCE = NATIVE / "src"

# Each level may include itself, what stands before it, and the public headers.
LEVELS = [
    ["support"],
    ["geometry"],
    ["solve"],
    ["measure"],
    ["cut"],
    ["coarsen"],
    ["input", "pack", "align", "layout", "reduce", "seams"],
    ["repair"],
    ["report"],
    ["placing"],
    ["rectangle_pictures", "place_and_squeeze", "cut_plan"],
    ["cut_along_edges"],
    ["reduce_pieces"],
    ["rectangles", "whole"],
    ["needed"],
    ["take_road"],
    ["one_atlas"],
    ["refine", "group_by_tile", "inspect"],
]
# Libraries that live in one place and nowhere else.
HOMES = {
    "OpenMesh": ["src/geometry/"],
    "CGAL": ["src/geometry/"],
    "CLI": ["cli/command_line.cpp"],
    "nlohmann": ["cli/report.cpp"],
    "pybind11": ["bindings/"],
}
TYPE = re.compile(r"^(?:struct|class|enum class) (\w+)[^;\n]*\{", re.MULTILINE)
INCLUDE = re.compile(r'^\s*#\s*include\s*(["<])([^">]+)[">]', re.MULTILINE)


def files(folder):
    return sorted(path for path in folder.rglob("*") if path.suffix in (".h", ".cpp"))


def includes(path):
    """(quoted, name) of everything that a file includes."""
    return [(mark == '"', name) for mark, name in INCLUDE.findall(path.read_text(encoding="utf-8"))]


def part(name):
    """The folder under src, or the file itself, without its ending, where it lies at the top."""
    return name.split("/")[0].removesuffix(".h").removesuffix(".cpp")


def level(name):
    return next((k for k, parts in enumerate(LEVELS) if name in parts), None)


def forbidden(includer, included):
    """Why one part may not include another; nothing where it may. Parts of one level, the stages, never include each other."""
    if included in ("atlas_refine", includer):
        return None
    if level(included) is None:
        return f"{included} has no place in the order"
    return None if level(included) < level(includer) else f"{includer} may not include {included}"


def test_every_source_has_its_place():
    assert {part(str(path.relative_to(SOURCE))) for path in files(SOURCE)} <= {name for names in LEVELS for name in names}


@pytest.mark.parametrize("path", files(SOURCE), ids=lambda path: str(path.relative_to(SOURCE)))
def test_sources_include_downwards_only(path):
    includer = part(str(path.relative_to(SOURCE)))
    wrong = [(name, forbidden(includer, part(name))) for quoted, name in includes(path) if quoted]
    assert [entry for entry in wrong if entry[1]] == []


# Besides the public headers and its own; the program knows file formats only through MeshFile.
SEEN = {
    "io": {f"io/{path.name}" for path in files(NATIVE / "io")},
    "cli": {"io/mesh_file.h", "io/input_file.h"},
    "bindings": set(),
}


@pytest.mark.parametrize("folder", SEEN)
def test_programs_see_only_the_public_headers(folder):
    seen = SEEN[folder] | {path.name for path in files(NATIVE / folder)}
    for path in files(NATIVE / folder):
        foreign = [name for quoted, name in includes(path) if quoted and name not in seen]
        assert [name for name in foreign if not name.startswith("atlas_refine/")] == [], path


def test_public_headers_include_only_each_other_eigen_and_the_standard_library():
    for path in files(NATIVE / "include"):
        for quoted, name in includes(path):
            assert name.startswith("atlas_refine/") if quoted else name.startswith("Eigen/") or "/" not in name, (path, name)


@pytest.mark.parametrize("library", HOMES)
def test_libraries_live_in_one_place(library):
    users = [
        str(path.relative_to(NATIVE)) for path in files(NATIVE) if any(n.startswith(f"{library}/") for _, n in includes(path))
    ]
    assert users
    assert [user for user in users if not user.startswith(tuple(HOMES[library]))] == []


def test_no_stage_includes_the_main_entry():
    users = [str(path.relative_to(SOURCE)) for path in files(SOURCE) if (True, "atlas_refine/refine.h") in includes(path)]
    assert users == ["refine.cpp"]


def test_includes_make_no_circle():
    graph = {
        str(p.relative_to(SOURCE)): [n for quoted, n in includes(p) if quoted and (SOURCE / n).exists()] for p in files(SOURCE)
    }
    done = set()

    def visit(name, above):
        assert name not in above, " -> ".join([*above, name])
        if name not in done:
            for included in graph[name]:
                visit(included, [*above, name])
            done.add(name)

    for name in graph:
        visit(name, [])


def test_headers_name_no_type_twice():
    """Two types of one name share their destructors: the linker keeps one of the two."""
    names = [
        (name, str(path.relative_to(NATIVE)))
        for path in files(NATIVE)
        if path.suffix == ".h"
        for name in TYPE.findall(path.read_text(encoding="utf-8"))
    ]
    first = dict(reversed(names))
    assert [(name, path, first[name]) for name, path in names if first[name] != path] == []


def test_the_rule_itself():
    assert forbidden("support", "geometry")
    assert forbidden("pack", "reduce")
    assert forbidden("reduce", "report")
    assert forbidden("report", "elsewhere")
    assert forbidden("pack", "measure") is None
    assert forbidden("measure", "atlas_refine") is None


# The sizes of the house, by Universal Ctags.
LARGEST_CLASS = 120
LARGEST_FUNCTION = 50
MEDIAN_FUNCTION = 7


def sizes(kinds, folder=NATIVE):
    """(lines, name, file) of every definition of these kinds, largest first."""
    command = ["ctags", "-R", "--languages=C++", "--fields=+ne", "--output-format=json", "-o", "-", "."]
    tags = map(json.loads, subprocess.run(command, cwd=folder, capture_output=True, text=True, check=True).stdout.splitlines())
    found = [(t["end"] - t["line"] + 1, t["name"], t["path"]) for t in tags if t.get("kind") in kinds and "end" in t]
    return sorted(found, reverse=True)


def test_no_class_is_a_program():
    classes = sizes({"class", "struct"})
    assert len(classes) > 100
    assert [entry for entry in classes if entry[0] > LARGEST_CLASS] == []


def test_functions_are_short():
    functions = sizes({"function"})
    assert len(functions) > 500
    assert [entry for entry in functions if entry[0] > LARGEST_FUNCTION] == []
    assert statistics.median(size for size, _, _ in functions) <= MEDIAN_FUNCTION


def test_sizes_are_those_of_definitions(tmp_path):
    (tmp_path / "a.cpp").write_text(
        "class A {\n  int f(int x) {\n    return x;\n  }\n};\nint g(int x,\n      int y) {\n  return x;\n}\n"
    )
    assert sizes({"class"}, tmp_path) == [(5, "A", "a.cpp")]
    assert sizes({"function"}, tmp_path) == [(4, "g", "a.cpp"), (3, "f", "a.cpp")]
