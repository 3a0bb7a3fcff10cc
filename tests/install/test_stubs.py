"""The type stub: mypy takes it and programs that use it, and it says of the module what the module is."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

REPOSITORY = Path(__file__).resolve().parents[2]
PACKAGE = REPOSITORY / "build" / "python"
EXAMPLE = REPOSITORY / "tests" / "install" / "example" / "refine_squares.py"


@pytest.fixture(scope="module")
def cache(tmp_path_factory):
    return tmp_path_factory.mktemp("mypy")


def mypy(cache, *arguments, module="mypy", package=PACKAGE):
    environment = {**os.environ, "MYPYPATH": str(package), "PYTHONPATH": str(package), "MYPY_CACHE_DIR": str(cache)}
    command = [sys.executable, "-m", module, *map(str, arguments)]
    return subprocess.run(command, cwd=cache, env=environment, capture_output=True, text=True, check=False)


def test_the_stub_and_a_program_are_strictly_typed(cache):
    done = mypy(cache, "--strict", PACKAGE / "atlas_refine" / "_atlas_refine.pyi", EXAMPLE)
    assert done.returncode == 0, done.stdout + done.stderr


@pytest.mark.parametrize(
    ("code", "error"),
    [
        ("atlas_refine.refine([], [], [], [], pe_bund=0.8)", "call-arg"),
        ('atlas_refine.refine([], [], [], [], seams="edges")', "arg-type"),
        ("atlas_refine.measure([], [], [], []).pee", "attr-defined"),
        ("atlas_refine.refine([], [], [], []).cut.face_sources", "union-attr"),
        ('atlas_refine.refine([], [], [], []).ended == "done"', "comparison-overlap"),
    ],
)
def test_mypy_refuses_wrong_use(cache, tmp_path, code, error):
    program = tmp_path / "wrong.py"
    program.write_text(f"import atlas_refine\n\n{code}\n")
    done = mypy(cache, "--strict", program)
    assert done.returncode == 1, done.stderr
    assert f"[{error}]" in done.stdout
    assert "Found 1 error" in done.stdout


#: What pybind11's classes have of their own, which is no part of the interface.
OF_PYBIND11 = ("is inconsistent, metaclass differs", "is inconsistent, stub does not have *args argument", ".__pybind11_")


def disagreements(cache, package):
    done = mypy(cache, "--concise", "atlas_refine", module="mypy.stubtest", package=package)
    assert done.stderr == ""
    lines = done.stdout.splitlines()
    assert any(OF_PYBIND11[0] in line for line in lines), done.stdout
    return [line for line in lines if not any(known in line for known in OF_PYBIND11)]


def test_the_stub_agrees_with_the_module(cache):
    assert disagreements(cache, PACKAGE) == []


def test_a_stub_that_does_not_agree_is_found(cache, tmp_path):
    package = shutil.copytree(PACKAGE, tmp_path / "python")
    stub = package / "atlas_refine" / "_atlas_refine.pyi"
    assert "def box_height" in stub.read_text()
    stub.write_text(stub.read_text().replace("def box_height", "def box_hight"))
    found = "\n".join(disagreements(tmp_path, package))
    assert "box_height is not present in stub" in found
    assert "box_hight is not present at runtime" in found
