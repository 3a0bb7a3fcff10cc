# SPDX-License-Identifier: GPL-3.0-or-later
"""Presets: built-in ones, the user's own and the studio's, by name.

A preset file is what Blender writes for an operator, lines as `op.pe_bound = 0.85`. It is read, never run: a file from elsewhere
can do nothing but set options.
"""

import ast
import pathlib
from dataclasses import dataclass, fields

from .options import Options

#: Where a preset comes from; of two with one name the first in this order counts.
OWN, STUDIO, BUILT_IN = "own", "studio", "built-in"

#: Options that belong to a scene or a machine and not to a purpose: built-in presets leave them alone.
_OF_THE_SCENE = ("uv_map", "keep_shape", "importance", "no_seam", "prefer_seam", "seed", "threads")

#: What differs from the defaults, for each purpose.
_PURPOSES = {
    # Mip maps blend over a chart's border: 8 pixels of 2048 last down to the fourth level.
    "Game Texture": {"gap_px": 8.0, "texture_size": 2048},
    # Each tile is a texture of its own; nothing is shared, and the least distortion is worth more than the last per cent.
    "Film UDIM Tile": {
        "pe_bound": 0.75,
        "tiles": "EACH",
        "gap_px": 16.0,
        "texture_size": 4096,
        "stacks": "SEPARATE",
        "density": "EQUAL",
        "relax": True,
    },
    # Light differs at each place, so that no two may share a texel, and it bleeds: a wide margin in a small square.
    "Lightmap": {
        "pe_bound": 0.7,
        "aspect": "SQUARE",
        "gap_px": 4.0,
        "texture_size": 512,
        "stacks": "SEPARATE",
        "density": "EQUAL",
        "tiles": "ONE",
        "write_to": "COPY",
    },
    # Texels are dear: charts may bend more for them.
    "Mobile": {"pe_bound": 0.85, "aspect": "SQUARE", "gap_px": 4.0, "texture_size": 1024, "tiles": "ONE"},
    # Liu et al. 2019: rectangles cut across faces, in whatever box.
    "Paper Defaults": {
        "seams": "RECTANGLES",
        "cut": "SPLIT",
        "aspect": "FREE",
        "gap": "AUTO",
        "density": "EQUAL",
        "tiles": "ONE",
    },
}


class PresetError(Exception):
    """The message is one line and names the preset."""


@dataclass(frozen=True)
class Preset:
    name: str
    source: str
    path: pathlib.Path | None = None  # None: built-in


def built_in_values(name):
    """All options that a built-in preset sets: those of its purpose, the others of the kind at their defaults."""
    purpose = _PURPOSES[name]
    return {field.name: purpose.get(field.name, field.default) for field in fields(Options) if field.name not in _OF_THE_SCENE}


def find_presets(own_folders, studio_folder):
    """All presets, in the order in which they are shown. Folders that are not there, or cannot be read, hold none."""
    found = [Preset(name, BUILT_IN) for name in _PURPOSES]
    found += _in_folder(studio_folder, STUDIO) if studio_folder else []
    for folder in own_folders:
        found += _in_folder(folder, OWN)
    return found


def preset_named(name, presets):
    """A preset by its name, whether written with spaces or as its file is; PresetError lists those there are."""
    matches = [preset for preset in presets if _key(preset.name) == _key(name)]
    if not matches:
        names = dict.fromkeys(preset.name for preset in presets)
        raise PresetError(f'there is no preset "{name}"; there are {", ".join(names)}')
    return min(matches, key=lambda preset: (OWN, STUDIO, BUILT_IN).index(preset.source))


def preset_values(preset, kinds):
    """{option: value}. `kinds`: {option: OptionKind}."""
    if preset.path is None:
        return built_in_values(preset.name)
    try:
        return _values_in(preset.path.read_text(encoding="utf-8"), kinds)
    except OSError as error:
        reason = error.strerror or "it cannot be read"
    except UnicodeDecodeError:
        reason = "it is not text"
    except SyntaxError as error:
        reason = f"line {error.lineno} is not Python"
    except (MemoryError, RecursionError):
        reason = "it is nested too deeply"
    except ValueError as error:  # a text with null characters too
        reason = str(error)
    raise PresetError(f'preset "{preset.name}" is broken: {reason} ({preset.path})')


def preset_text(values):
    """A preset file, as Blender writes one for an operator."""
    lines = ["import bpy", "op = bpy.context.active_operator", "", *(f"op.{name} = {value!r}" for name, value in values.items())]
    return "\n".join(lines) + "\n"


def _in_folder(folder, source):
    try:
        paths = sorted(path for path in pathlib.Path(folder).iterdir() if path.suffix == ".py" and not path.name.startswith("."))
    except OSError:
        return []
    return [Preset(_name_of(path.stem), source, path) for path in paths]


def _name_of(stem):
    """As Blender shows a file: game_texture is Game Texture."""
    name = stem.replace("_", " ")
    return name.title() if name.islower() else name


def _key(name):
    return "".join(character if character.isalnum() else " " for character in name.casefold()).strip()


def _values_in(text, kinds):
    values = {}
    for statement in ast.parse(text).body:
        if isinstance(statement, ast.Assign) and isinstance(statement.targets[0], ast.Attribute):
            name = statement.targets[0].attr
            if name not in kinds:
                raise ValueError(f'line {statement.lineno}: there is no option "{name}"')
            values[name] = _value_of(statement, kinds[name])
    if not values:
        raise ValueError("it sets no option")
    return values


def _value_of(statement, kind):
    try:
        value = ast.literal_eval(statement.value)
    except ValueError:
        raise ValueError(f"line {statement.lineno}: {kind.name} is not a plain value") from None
    try:
        return kind.checked(value)
    except ValueError as error:
        raise ValueError(f"line {statement.lineno}: {error}") from None
