"""Packs the UV charts of a mesh with another program's packer. Writes the corners' UVs beside the mesh; prints one line of JSON.

usage: PYTHON pack_with_peer.py xatlas|pack_islands MESH.npz GAP      in a Python that has xatlas, or bpy

MESH.npz: positions, offsets of faces, corner_vertex, corner_uv; the result is MESH.npy. GAP: between charts, as a fraction of the
unit square's diagonal. The seconds are the processor's, of all threads, in the packer alone.
"""

import json
import math
import sys
import time
from pathlib import Path

import numpy as np

RESOLUTION = 1024  # that xatlas packs at; its charts are whole texels apart


def fans(offsets):
    """Corners of the triangles that polygons are fans of."""
    sides = np.diff(offsets)
    first = np.repeat(offsets[:-1], sides - 2)
    step = np.concatenate([np.arange(1, n - 1) for n in sides])
    return np.stack([first, first + step, first + step + 1], axis=1)


def with_xatlas(mesh, gap):
    import xatlas

    uvs, vertices = np.unique(mesh["corner_uv"].astype(np.float32), axis=0, return_inverse=True)
    corners = fans(mesh["offsets"])
    atlas = xatlas.Atlas()
    atlas.add_uv_mesh(uvs, vertices.reshape(-1)[corners].astype(np.uint32))
    options = xatlas.PackOptions()
    options.resolution, options.bruteForce = RESOLUTION, True
    options.padding = math.ceil(gap * math.sqrt(2) * RESOLUTION)
    options.rotate_charts = False  # by swapping u and v, which mirrors them; that onto their axes stays
    began = time.process_time()
    atlas.generate(pack_options=options)
    seconds = time.process_time() - began
    if atlas.atlas_count != 1:
        raise RuntimeError(f"{atlas.atlas_count} atlases")
    _, indices, packed = atlas.get_mesh(0)
    out = np.empty_like(mesh["corner_uv"], dtype=np.float64)
    out[corners] = packed.astype(np.float64)[indices] * (atlas.width, atlas.height) / max(atlas.width, atlas.height)
    return out, seconds


def with_pack_islands(mesh, gap):
    import bpy

    bpy.ops.wm.read_factory_settings(use_empty=True)
    faces = np.split(mesh["corner_vertex"], mesh["offsets"][1:-1])
    data = bpy.data.meshes.new("mesh")
    data.from_pydata(mesh["positions"].tolist(), [], [face.tolist() for face in faces])
    data.uv_layers.new(name="UVMap").data.foreach_set("uv", mesh["corner_uv"].astype(np.float32).ravel())
    obj = bpy.data.objects.new("mesh", data)
    bpy.context.scene.collection.objects.link(obj)
    bpy.context.view_layer.objects.active = obj
    obj.select_set(True)
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.uv.select_all(action="SELECT")
    began = time.process_time()
    # The margin is kept to the border, and twice between charts.
    margin = gap * math.sqrt(2) / 2
    bpy.ops.uv.pack_islands(rotate_method="ANY", shape_method="CONCAVE", margin_method="FRACTION", margin=margin)
    seconds = time.process_time() - began
    bpy.ops.object.mode_set(mode="OBJECT")
    out = np.empty(2 * len(mesh["corner_vertex"]), dtype=np.float32)
    data.uv_layers.active.data.foreach_get("uv", out)
    return out.reshape(-1, 2).astype(np.float64), seconds


def main(peer, path, gap):
    pack = {"xatlas": with_xatlas, "pack_islands": with_pack_islands}[peer]
    corner_uv, seconds = pack(np.load(path), float(gap))
    np.save(Path(path).with_suffix(".npy"), corner_uv)
    print(json.dumps({"peer": peer, "seconds": seconds}), flush=True)


if __name__ == "__main__":
    arguments = [word for word in sys.argv[1:] if word != "--"]
    if len(arguments) != 3:
        sys.exit(__doc__)
    main(*arguments)
