# SPDX-License-Identifier: GPL-3.0-or-later
"""What charts are packed for: textures of materials or one of all, and their tiles."""

from dataclasses import dataclass

import numpy as np

from .joined import Joined
from .options import Texture
from .who import group_faces
from .words import counted


@dataclass(frozen=True)
class Canvas:
    """A texture, with its tiles."""

    texture: Texture | None = None  # None: no image tells its size
    tile: tuple = (0, 0)  # lower left corner of the active one
    name: str = ""  # of the material whose texture it is


@dataclass(frozen=True)
class Places:
    """Where the taken faces are packed."""

    codes: np.ndarray  # (F, 2) canvas and tile
    corners: np.ndarray  # (T, 2) lower left ones of the tiles
    names: list  # of the tiles; "" is the first one of a texture that has no others

    def without(self, flags):
        """These faces."""
        return Places(self.codes[~flags], self.corners, self.names)


def places_of(engine, parts, options, canvases):
    """`canvases`: of each material's number where each has a texture of its own, else one."""
    by_material = options.atlases == "MATERIAL"
    of_faces = np.concatenate([part.materials[part.taken] if by_material else 0 * part.materials[part.taken] for part in parts])
    to_first = np.array([options.tiles_of(canvas.texture) == "ONE" for canvas in canvases])[of_faces]
    if to_first.all():
        return Places(np.column_stack([of_faces, 0 * of_faces]), np.zeros((1, 2)), [""])
    tiles, corners, names = engine.group_by_tile(*Joined(parts).arrays())
    tiles = np.where(to_first, len(names), tiles)
    return Places(np.column_stack([of_faces, tiles]), np.vstack([corners, np.zeros((1, 2))]), [*names, ""])


def beside_active_tiles(places, canvases):
    """(F,) bool: faces that lie in another tile than the active one of their texture."""
    active = np.array([canvas.tile for canvas in canvases])
    canvas, tile = places.codes.T
    return np.any(places.corners[tile] != active[canvas], axis=1)


def missing_tiles(places, canvases):
    """Notes on faces in tiles that their tiled image does not have."""
    groups, first = group_faces(places.codes)
    for (canvas, tile), count in zip(places.codes[first].tolist(), np.bincount(groups).tolist(), strict=True):
        texture, name = canvases[canvas].texture, places.names[tile]
        if texture is not None and texture.is_tiled and name and name not in map(str, texture.tiles):
            tile = name if name.startswith("tile") else f"tile {name}"
            yield f"{texture.name} has no {tile}, in which {counted(count, 'face')} lie and are packed: add it, or move them"
