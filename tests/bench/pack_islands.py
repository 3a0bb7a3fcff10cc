"""Blender's own packing of an OBJ, for comparison: exact shapes, any rotation, the best that 4.2 and later offer.

usage: PYTHON_WITH_BPY pack_islands.py IN.obj OUT.obj MARGIN     MARGIN is a fraction of the box's side
"""

import sys
import time

import bpy


def main(source, target, margin):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.wm.obj_import(filepath=source)
    bpy.context.view_layer.objects.active = bpy.context.selected_objects[0]
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.uv.select_all(action="SELECT")
    began = time.monotonic()
    bpy.ops.uv.pack_islands(rotate_method="ANY", shape_method="CONCAVE", margin_method="FRACTION", margin=float(margin))
    print(f"pack_islands: {time.monotonic() - began:.2f} s")
    bpy.ops.object.mode_set(mode="OBJECT")
    bpy.ops.wm.obj_export(filepath=target, export_selected_objects=True, export_materials=False)


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    main(*sys.argv[1:])
