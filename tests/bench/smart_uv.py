"""Blender's Smart UV Project of an OBJ file, for meshes that come without UVs.

usage: blender --background --factory-startup --python smart_uv.py -- IN.obj OUT.obj
"""

import math
import sys

import bpy


def main(source, target):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.wm.obj_import(filepath=source)
    meshes = [thing for thing in bpy.context.scene.objects if thing.type == "MESH"]
    if not meshes:
        sys.exit("smart_uv: no mesh in the file")
    for thing in meshes:
        thing.select_set(True)
    bpy.context.view_layer.objects.active = meshes[0]
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.uv.smart_project(angle_limit=math.radians(66), island_margin=0.0)
    bpy.ops.object.mode_set(mode="OBJECT")
    bpy.ops.wm.obj_export(filepath=target, export_selected_objects=True, export_materials=False, export_normals=False)


if __name__ == "__main__":
    main(*sys.argv[sys.argv.index("--") + 1 :])
