"""Packs addon/ and the built Python package into one zip: an extension for Blender 4.2+, a legacy add-on for 3.4 to 4.1.

usage: package_addon.py OUT_DIR BUILD_DIR...

Several build folders, each for another Python, make one zip that runs on all of them.
"""

import hashlib
import pathlib
import re
import sys
import zipfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
#: The zip's one folder. Not "atlas_refine": a legacy add-on's folder is a top level module and would hide the Python package.
FOLDER = "atlas_refine_addon"
#: The first official Blender that no longer runs a module of this Python; those before 4.2 read no manifest.
NOT_SUPPORTED_FROM = {"cpython-311": "5.1.0", "cpython-313": "5.3.0"}
EPOCH = (1980, 1, 1, 0, 0, 0)  # the same files make the same zip


def files(folder, patterns):
    found = sorted(path for pattern in patterns for path in folder.rglob(pattern) if "__pycache__" not in path.parts)
    return [(path.relative_to(folder), path) for path in found]


def write(archive, name, data):
    info = zipfile.ZipInfo(f"{FOLDER}/{name}", EPOCH)
    info.external_attr = 0o644 << 16
    info.compress_type = zipfile.ZIP_DEFLATED
    archive.writestr(info, data)


def built_packages(build_dirs):
    """Files of the Python package by their name, of all builds."""
    native = {}
    for build_dir in build_dirs:
        package = pathlib.Path(build_dir) / "python" / "atlas_refine"
        found = dict(files(package, ["*.py", "*.pyi", "py.typed", "*.so", "*.so.*"]))
        if not any(name.suffix == ".so" for name in found):
            sys.exit(f"{package} holds no built module; run ./dev build first")
        native.update(found)
    return native


def write_folder(archive):
    """An entry of its own, by which Blender 3.4 to 4.1 takes the old version away before it unpacks this one: a library that is loaded
    must not be written over."""
    info = zipfile.ZipInfo(f"{FOLDER}/", EPOCH)
    info.external_attr = 0o40755 << 16 | 0x10
    archive.writestr(info, b"")


def engine_folder(native):
    """Named by what it holds: Python and the loader know libraries by their path, and would give a newer version the one they have."""
    digest = hashlib.sha256()
    for name, path in sorted(native.items()):
        digest.update(name.as_posix().encode() + path.read_bytes())
    return f"atlas_refine_{digest.hexdigest()[:12]}"


def manifest(native):
    """(text, version) with the last Blender that one of the modules runs on."""
    text = (ROOT / "addon" / "blender_manifest.toml").read_text()
    limits = [limit for name in native for python, limit in NOT_SUPPORTED_FROM.items() if python in name.name]
    if not limits:
        sys.exit(f"no module for the Python of Blender 4.2 or later; there are {', '.join(NOT_SUPPORTED_FROM)}")
    text = re.sub("(?m)^(blender_version_min = .*)$", rf'\1\nblender_version_max = "{max(limits)}"', text)
    return text, re.search(r'(?m)^version = "(.+)"$', text).group(1)


def main(out_dir, *build_dirs):
    native = built_packages(build_dirs)
    manifest_text, version = manifest(native)
    out = pathlib.Path(out_dir) / f"atlas_refine-{version}.zip"
    out.parent.mkdir(parents=True, exist_ok=True)
    folder = engine_folder(native)
    with zipfile.ZipFile(out, "w") as archive:
        write_folder(archive)
        for name, path in files(ROOT / "addon", ["*.py"]):
            write(archive, name.as_posix(), path.read_bytes())
        write(archive, "blender_manifest.toml", manifest_text.encode())
        write(archive, "LICENSE", (ROOT / "LICENSE").read_bytes())
        write(archive, "native/__init__.py", f"from . import {folder} as atlas_refine\n".encode())
        for name, path in sorted(native.items()):
            write(archive, f"native/{folder}/{name.as_posix()}", path.read_bytes())
    print(out)


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
