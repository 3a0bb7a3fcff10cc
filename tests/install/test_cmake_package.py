"""cmake --install: a program of someone else finds the library with find_package(atlas_refine), builds and runs."""

import os
import shutil
import subprocess
from pathlib import Path

import pytest

REPOSITORY = Path(__file__).resolve().parents[2]
BUILD = REPOSITORY / "build"


def run(*command, **options):
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True, check=False, **options)
    assert done.returncode == 0, f"{command}:\n{done.stdout}{done.stderr}"
    return done.stdout


@pytest.fixture(scope="module")
def prefix(tmp_path_factory):
    """Installed in one place and moved to another: no path of the first may be in it."""
    folder = tmp_path_factory.mktemp("installed")
    run("cmake", "--install", BUILD, "--prefix", folder / "first")
    return (folder / "first").rename(folder / "moved")


def test_what_is_installed(prefix):
    installed = {str(path.relative_to(prefix)) for path in prefix.rglob("*") if path.is_file()}
    assert {"bin/atlas-refine", "include/atlas_refine/refine.h"} < installed
    assert [path for path in installed if path.endswith(("Config.cmake", "-config.cmake"))] == [
        "lib/cmake/atlas_refine/atlas_refine-config.cmake"
    ]
    assert [path for path in installed if "test" in path or "python" in path] == []
    assert run(prefix / "bin" / "atlas-refine", "--version").startswith("atlas-refine ")


def test_a_program_that_finds_the_package(prefix, tmp_path):
    shutil.copytree(REPOSITORY / "tests" / "install" / "example", tmp_path / "example")
    launcher = {"CMAKE_CXX_COMPILER_LAUNCHER": "ccache"} if shutil.which("ccache") else {}
    configure = ["cmake", "-S", "example", "-B", "build", "-G", "Ninja", f"-DCMAKE_PREFIX_PATH={prefix}"]
    run(*configure, cwd=tmp_path, env={**os.environ, **launcher})
    run("cmake", "--build", "build", cwd=tmp_path)
    told = run(tmp_path / "build" / "example", cwd="/")
    assert told.startswith("moved: PE 0.03125 -> ")
    assert float(told.split()[-1]) >= 0.9


@pytest.mark.parametrize(("version", "found"), [("0.1.0", True), ("0.0.9", False), ("0.2", False), ("1", False)])
def test_the_version_that_is_asked_for(prefix, tmp_path, version, found):
    (tmp_path / "CMakeLists.txt").write_text(
        f"cmake_minimum_required(VERSION 3.25)\nproject(asks LANGUAGES CXX)\nfind_package(atlas_refine {version} REQUIRED)\n"
    )
    command = ["cmake", "-S", tmp_path, "-B", tmp_path / "build", f"-DCMAKE_PREFIX_PATH={prefix}"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert (done.returncode == 0) is found, done.stderr
    assert found or "compatible" in done.stderr
