"""tools/package_addon.py and tools/check_portable.py: what the zip says of itself, and what a module needs of a machine."""

import pathlib
import shutil
import subprocess
import sys
import zipfile

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools"))

import check_portable
import package_addon


def make_build(folder, python, content=b"module"):
    package = folder / python / "python" / "atlas_refine"
    package.mkdir(parents=True)
    (package / "__init__.py").write_text("")
    (package / f"_atlas_refine.{python}-x86_64-linux-gnu.so").write_bytes(content)
    return folder / python


def packed(folder, *builds):
    package_addon.main(folder / "dist", *builds)
    (archive,) = (folder / "dist").glob("*.zip")
    return zipfile.ZipFile(archive)


def in_manifest(archive, line):
    return line in archive.read("atlas_refine_addon/blender_manifest.toml").decode().splitlines()


@pytest.mark.parametrize(
    ("pythons", "limit"),
    [(["cpython-311"], "5.1.0"), (["cpython-310", "cpython-311"], "5.1.0"), (["cpython-311", "cpython-313"], "5.3.0")],
)
def test_the_zip_goes_as_far_as_its_modules_do(tmp_path, pythons, limit):
    with packed(tmp_path, *(make_build(tmp_path, python) for python in pythons)) as archive:
        assert in_manifest(archive, f'blender_version_max = "{limit}"')
        assert in_manifest(archive, 'blender_version_min = "4.2.0"')
        assert len([name for name in archive.namelist() if name.endswith(".so")]) == len(pythons)


def test_a_zip_without_a_module_for_todays_blenders_is_not_made(tmp_path):
    with pytest.raises(SystemExit, match="4.2 or later"):
        package_addon.main(tmp_path / "dist", make_build(tmp_path, "cpython-310"))
    assert not (tmp_path / "dist").exists()


def test_the_folder_has_an_entry_of_its_own(tmp_path):
    with packed(tmp_path, make_build(tmp_path, "cpython-311")) as archive:
        assert archive.namelist()[0] == "atlas_refine_addon/"
        assert archive.infolist()[0].is_dir()


def test_another_engine_lies_in_another_folder(tmp_path):
    folders = []
    for content in (b"one", b"other", b"one"):
        shutil.rmtree(tmp_path / "cpython-311", ignore_errors=True)
        with packed(tmp_path, make_build(tmp_path, "cpython-311", content)) as archive:
            (library,) = [name for name in archive.namelist() if name.endswith(".so")]
            folders.append(library.split("/")[2])
            assert (
                archive.read("atlas_refine_addon/native/__init__.py").decode() == f"from . import {folders[-1]} as atlas_refine\n"
            )
    assert folders[0] != folders[1]
    assert folders[0] == folders[2]


def test_what_a_module_needs_of_a_machine(tmp_path):
    """A library of this machine's compiler, with what is newer than allowed."""
    source = tmp_path / "a.c"
    source.write_text("#include <stdlib.h>\nunsigned f(void) { return arc4random(); }\n")  # glibc 2.36
    library = tmp_path / "a.so"
    subprocess.run(["cc", "-shared", "-fPIC", source, "-o", library, "-Wl,--no-as-needed", "-lstdc++"], check=True)
    assert set(check_portable.faults(library)) == {"glibc 2.36: arc4random", "needs libstdc++.so.6"}
    source.write_text("#include <stdlib.h>\nint f(void) { return abs(rand()); }\n")
    subprocess.run(["cc", "-shared", "-fPIC", source, "-o", library], check=True)
    assert list(check_portable.faults(library)) == []
