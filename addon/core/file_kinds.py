# SPDX-License-Identifier: GPL-3.0-or-later
"""The kinds of files that the headless script reads besides .blend, whose results are .blend files."""

import pathlib

#: By suffix: operators that import such files, the first that there is counts, and the add-on of Blender's that an operator is of.
IMPORTERS = {
    ".obj": (("wm.obj_import", ""),),
    ".gltf": (("import_scene.gltf", "io_scene_gltf2"),),
    ".glb": (("import_scene.gltf", "io_scene_gltf2"),),
    ".fbx": (("wm.fbx_import", ""), ("import_scene.fbx", "io_scene_fbx")),  # the first from 4.5 on
}


def is_imported(path):
    return pathlib.Path(path).suffix.lower() in IMPORTERS


def result_name(path):
    path = pathlib.Path(path)
    return f"{path.stem}.blend" if is_imported(path) else path.name
