"""pip builds a wheel of the tree; in a fresh environment it imports from any folder and refines, with nothing but NumPy beside."""

import json
import os
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest
import tomllib

REPOSITORY = Path(__file__).resolve().parents[2]
EXAMPLE = REPOSITORY / "tests" / "install" / "example" / "refine_squares.py"

#: Run after an import: where the libraries of the module were loaded from.
LOADED = """
import sys, atlas_refine
print(sorted({line.split()[-1] for line in open("/proc/self/maps") if "OpenMesh" in line or "_atlas_refine" in line}))
"""


def run(*command, **options):
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True, check=False, **options)
    assert done.returncode == 0, f"{command}:\n{done.stdout[-4000:]}{done.stderr[-4000:]}"
    return done.stdout


@pytest.fixture(scope="module")
def environment():
    """Without what points Python at the build folder. ccache has the objects of that folder, if the compiler has the same name."""
    settings = {name: value for name, value in os.environ.items() if not name.startswith(("PYTHON", "PIP_"))}
    return {"CXX": "c++"} | settings | ({"CMAKE_CXX_COMPILER_LAUNCHER": "ccache"} if shutil.which("ccache") else {})


@pytest.fixture(scope="module")
def python(tmp_path_factory, environment):
    """Of a fresh environment. The build's packages and NumPy come from PyPI: without it there is nothing to test."""
    folder = tmp_path_factory.mktemp("venv")
    run(sys.executable, "-m", "venv", folder / "venv")
    python = folder / "venv" / "bin" / "python"
    settings = tomllib.loads((REPOSITORY / "pyproject.toml").read_text())
    wanted = [*settings["build-system"]["requires"], *settings["project"]["dependencies"]]
    command = [python, "-m", "pip", "download", "-q", "--no-deps", "-d", folder / "downloads", *wanted]
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    if "(from versions: none)" in done.stderr:
        pytest.skip(f"PyPI cannot be reached: {done.stderr.strip().splitlines()[-1]}")
    assert done.returncode == 0, done.stderr
    return python


@pytest.fixture(scope="module")
def wheel(python, environment, tmp_path_factory):
    folder = tmp_path_factory.mktemp("wheel")
    # The folder of ./dev wheel: what it has compiled before is not compiled again.
    options = ["--no-deps", "-w", folder, "--config-settings", "build-dir=build-wheel"]
    run(python, "-m", "pip", "wheel", REPOSITORY, *options, cwd=folder, env=environment)
    (path,) = folder.iterdir()
    return path


def test_the_wheel_holds_the_package_and_nothing_else(wheel):
    with zipfile.ZipFile(wheel) as archive:
        names = {name for name in archive.namelist() if ".dist-info/" not in name}
        (metadata,) = (archive.read(name).decode() for name in archive.namelist() if name.endswith("/METADATA"))
    (module,) = (name for name in names if name.startswith("atlas_refine/_atlas_refine.cpython-"))
    (library,) = (name for name in names if name.startswith("atlas_refine/libOpenMeshCore.so"))
    package = {f"atlas_refine/{name}" for name in ("__init__.py", "_atlas_refine.pyi", "packing.py", "py.typed")}
    assert names == package | {module, library}
    assert f"Version: {wheel.name.split('-')[1]}\n" in metadata
    assert "Requires-Dist: numpy" in metadata


def test_the_wheel_in_a_fresh_environment(wheel, python, environment, tmp_path):
    run(python, "-m", "pip", "install", "-q", wheel, cwd=tmp_path, env=environment)
    loaded = run(python, "-c", LOADED, cwd=tmp_path, env=environment)
    assert loaded.count(str(python.parents[1] / "lib")) == 2, loaded
    script = shutil.copy(EXAMPLE, tmp_path)
    result = json.loads(run(python, script, cwd=tmp_path, env=environment))
    assert result["after"]["pe"] >= 0.9
    version = run(python, "-c", "import atlas_refine; print(atlas_refine.__version__)", cwd="/", env=environment)
    assert version.strip() == wheel.name.split("-")[1]
