"""Packs addon/ and the built Python package into one zip: an extension for Blender 4.2+, a legacy add-on before.

usage: package_addon.py OUT_DIR BUILD_DIR...

Several build folders, each for another Python, make one zip that runs on all of them.
"""

import pathlib
import re
import sys
import zipfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
#: The zip's one folder. Not "atlas_refine": a legacy add-on's folder is a top level module and would hide the Python package.
FOLDER = "atlas_refine_addon"
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


def main(out_dir, *build_dirs):
    native = built_packages(build_dirs)
    manifest = (ROOT / "addon" / "blender_manifest.toml").read_text()
    version = re.search(r'^version = "(.+)"$', manifest, re.MULTILINE).group(1)
    out = pathlib.Path(out_dir) / f"atlas_refine-{version}.zip"
    out.parent.mkdir(parents=True, exist_ok=True)
    with zipfile.ZipFile(out, "w") as archive:
        for name, path in files(ROOT / "addon", ["*.py", "*.toml"]):
            write(archive, name.as_posix(), path.read_bytes())
        write(archive, "LICENSE", (ROOT / "LICENSE").read_bytes())
        write(archive, "native/__init__.py", b"")
        for name, path in sorted(native.items()):
            write(archive, f"native/atlas_refine/{name.as_posix()}", path.read_bytes())
    print(out)


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
