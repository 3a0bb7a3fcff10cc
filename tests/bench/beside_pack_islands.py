"""One OBJ in Blender: its UV map as it is, and as Blender's own Pack Islands or the add-on leaves it. One line of JSON.

usage: PYTHON_WITH_BPY beside_pack_islands.py IN.obj WAY BOUND MARGIN_PX TEXTURE_SIZE     with the add-on installed in the profile

WAY is "pack islands", which takes exact shapes and any rotation, the best that 3.6 and later offer, or "atlas refine". The same
program measures all three.
"""

import json
import math
import sys
import time

import bpy
import numpy as np

MODULE = "bl_ext.user_default.atlas_refine"


def load(source):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.preferences.addon_enable(module=MODULE)
    bpy.ops.wm.obj_import(filepath=source)
    obj = bpy.context.selected_objects[0]
    bpy.context.view_layer.objects.active = obj
    return obj


def figures(obj, size, seconds):
    """Of the square texture; distances in its pixels."""
    atlas = sys.modules[f"{MODULE}.bridge.mesh"].read_atlas(obj, obj.data.uv_layers.active.name)
    engine = sys.modules[f"{MODULE}.engine"]
    arrays = atlas.as_tuple()
    measures = engine.measure(*arrays, box_aspect=1.0, in_texture=True)
    free = engine.measure(*arrays)
    uvs = atlas.corner_uvs.astype(np.float64)
    gap = free.gap_between * math.hypot(free.box_width, free.box_height) * size
    return {
        "use": measures.pe_fixed_aspect,
        "e_d": measures.distortion,
        "charts": measures.chart_count,
        "gap_px": gap if math.isfinite(gap) else None,  # None: one chart
        "border_px": float(min(uvs.min(), 1 - uvs.max())) * size,
        "valid": engine.module.validate(*arrays).valid,
        "seconds": seconds,
    }


def timed(work):
    began = time.process_time()
    work()
    return time.process_time() - began


def pack_islands(_bound, margin_px, size):
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.uv.select_all(action="SELECT")
    seconds = timed(
        lambda: bpy.ops.uv.pack_islands(
            rotate_method="ANY", shape_method="CONCAVE", margin_method="FRACTION", margin=margin_px / size
        )
    )
    bpy.ops.object.mode_set(mode="OBJECT")
    return seconds


def atlas_refine(bound, margin_px, size):
    options = {"pe_bound": bound, "aspect": "SQUARE", "gap": "PIXELS", "gap_px": margin_px, "texture_size": size, "threads": 1}
    return timed(lambda: bpy.ops.uv.atlas_refine(**options))


WAYS = {"pack islands": pack_islands, "atlas refine": atlas_refine}


def main(source, way, bound, margin_px, size):
    bound, margin_px, size = float(bound), float(margin_px), int(size)
    obj = load(source)
    found = {"triangles": sum(len(face.vertices) - 2 for face in obj.data.polygons), "input": figures(obj, size, 0.0)}
    try:
        found[way] = figures(obj, size, WAYS[way](bound, margin_px, size))
    except RuntimeError as error:
        found["why not"] = str(error).strip().splitlines()[-1]
    print(json.dumps(found), flush=True)


if __name__ == "__main__":
    if len(sys.argv) != 6 or sys.argv[2] not in WAYS:
        sys.exit(__doc__)
    main(*sys.argv[1:])
