"""Meshes with four times the triangles of the test meshes, sixteen times, ...: every triangle divided at the midpoints of its edges."""

from pathlib import Path

import numpy as np
from obj_text import read_obj
from pack_with_peer import fans


def halved(values, triangles):
    """One level: the values with those of midpoints behind them, and the four parts of each triangle."""
    ends = np.sort(np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]), axis=1)
    edges, edge_of = np.unique(ends, axis=0, return_inverse=True)
    a, b, c = triangles.T
    ab, bc, ca = len(values) + edge_of.reshape(3, -1)
    parts = [(a, ab, ca), (b, bc, ab), (c, ca, bc), (ab, bc, ca)]
    finer = np.concatenate([np.stack(part, axis=1) for part in parts])
    return np.concatenate([values, values[edges].mean(axis=1)]), finer


def subdivided(path, levels, folder):
    """An OBJ file of `path`'s mesh, `levels` times divided, in `folder`; made where it is not there."""
    result = Path(folder) / f"{path.stem}_x{4**levels}.obj"
    if result.exists():
        return result
    mesh = read_obj(path)
    corners = fans(mesh.offsets)
    uvs, record = np.unique(mesh.corner_uv, axis=0, return_inverse=True)
    positions, faces, uv_faces = mesh.positions, mesh.corner_vertex[corners], record.reshape(-1)[corners]
    for _ in range(levels):
        positions, faces = halved(positions, faces)
        uvs, uv_faces = halved(uvs, uv_faces)
    result.parent.mkdir(parents=True, exist_ok=True)
    unfinished = result.with_suffix(".part")
    with open(unfinished, "w") as file:
        np.savetxt(file, positions, fmt="v %.17g %.17g %.17g")
        np.savetxt(file, uvs, fmt="vt %.17g %.17g")
        np.savetxt(file, np.stack([faces, uv_faces], axis=2).reshape(len(faces), 6) + 1, fmt="f %d/%d %d/%d %d/%d")
    unfinished.rename(result)
    return result
