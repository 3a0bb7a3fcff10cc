"""The files that the benchmark runs on: one's own, or the folders of the test meshes."""

import os
import subprocess
from pathlib import Path

FOLDERS = {
    "disk": "disk",
    "disk_deep": "disk_deep",
    "atlas-clean": "uv/atlas-clean",
    "atlas-nondisk-charts": "uv/atlas-nondisk-charts",
}
# Atlases as they are found, and meshes without UVs.
REAL_FOLDERS = {
    name: name
    for name in (
        *(f"uv/{kind}" for kind in ("single-disk", "single-disk-lowdist", "atlas-clean", "atlas-nondisk-charts")),
        *(f"uv/{kind}" for kind in ("atlas-with-defects", "overlapping-tiled", "palette-degenerate-uv")),
        *(f"no_uv/{kind}" for kind in ("disk-no-uv", "closed-no-uv", "no-uv", "bad-uv")),
    )
}
REQUIRED_FOLDERS = list(FOLDERS)[:3]
VARIABLE = "ATLAS_REFINE_MESHES"
HOW = (
    f"name OBJ files or folders of them with --meshes, or the folder of the test meshes (disk/, disk_deep/, uv/) with {VARIABLE}"
)


class NoMeshesError(Exception):
    """There is nothing to run on; the message says why, and what to do."""

    def __init__(self, why):
        super().__init__(f"no meshes: {why}; {HOW}")


def own_meshes(paths):
    """{name: OBJ files}: a folder with all that lie in it at any depth, and files under the name of the folder they are in."""
    found = {}
    for path in map(Path, paths):
        if path.is_dir():
            found.setdefault(path.resolve().name, []).extend(
                p for p in path.rglob("*") if p.suffix.lower() == ".obj" and p.is_file()
            )
        elif path.is_file():
            found.setdefault(path.resolve().parent.name, []).append(path)
        else:
            raise NoMeshesError(f"there is no {path}")
    if not any(found.values()):
        raise NoMeshesError(f"no OBJ file in {', '.join(map(str, paths))}")
    return found


def mesh_root(shared):
    """The folder of the test meshes: the variable's, else what data/unpack.sh of the folder `shared` unpacks."""
    named, unpack = os.environ.get(VARIABLE), shared / "data" / "unpack.sh"
    if not named and not unpack.exists():
        raise NoMeshesError(f"{VARIABLE} is not set")
    if not named:
        named = subprocess.run(["bash", unpack], capture_output=True, text=True, check=True).stdout.split("\n")[-2]
    if not (Path(named) / "disk").is_dir():
        raise NoMeshesError(f"{named} holds no disk/")
    return Path(named)


def folder_meshes(root, folders):
    return {folder: list((root / (FOLDERS | REAL_FOLDERS)[folder]).glob("*.obj")) for folder in folders}
