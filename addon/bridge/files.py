# SPDX-License-Identifier: GPL-3.0-or-later
"""Opens .blend files, and files of other kinds with the importers that Blender has."""

import json
import re
from urllib.parse import unquote

import addon_utils
import bpy

from ..core.file_kinds import IMPORTERS, is_imported


class UnreadableError(Exception):
    """Blender cannot read the file; the message is one line and does not name it."""


def open_file(path):
    """The scene becomes the file's, in object mode; scripts in it are not run."""
    if is_imported(path):
        _import(path)
        return
    _run(bpy.ops.wm.open_mainfile, filepath=str(path), load_ui=True, use_scripts=False)
    if bpy.context.mode != "OBJECT":
        bpy.ops.object.mode_set(mode="OBJECT")


def files_of(path):
    """The file, and those beside it that hold a part of its meshes."""
    if path.suffix.lower() != ".gltf":
        return [path]
    try:
        uris = [buffer.get("uri", "data:") for buffer in json.loads(path.read_text(encoding="utf-8")).get("buffers", [])]
    except (ValueError, AttributeError, TypeError):
        return [path]
    beside = [path.parent / unquote(uri) for uri in uris if not uri.startswith("data:")]
    return [path, *(file for file in beside if file.is_file())]


def _import(path):
    operator = _first_there(IMPORTERS[path.suffix.lower()])
    if operator is None:
        raise UnreadableError(f"this Blender has no importer for {path.suffix} files")
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    _run(operator, filepath=str(path))


def _first_there(candidates):
    for name, addon in candidates:
        if not _is_there(name) and addon:
            addon_utils.enable(addon)
        if _is_there(name):
            return _operator(name)
    return None


def _operator(name):
    module, function = name.split(".")
    return getattr(getattr(bpy.ops, module), function)


def _is_there(name):
    try:
        _operator(name).get_rna_type()
    except KeyError:
        return False
    return True


def _run(operator, **arguments):
    try:
        finished = "FINISHED" in operator(**arguments)
    except RuntimeError as error:
        raise UnreadableError(_why(str(error))) from None
    if not finished:
        raise UnreadableError("Blender cannot open it")


def _why(text):
    """From what an operator reports; an importer that is a script hands on its whole traceback."""
    raised = re.search(r"^\w+(Error|Exception): .*", text, re.MULTILINE) if "Traceback" in text else None
    if raised:
        return f"Blender's importer failed: {raised[0]}"
    return f"Blender cannot open it: {' '.join(text.split())}"
