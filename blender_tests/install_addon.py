"""Installs the add-on's zip as a user does, into the profile BLENDER_USER_RESOURCES: after `--`, the zip."""

import sys

import bpy

zip_file = sys.argv[sys.argv.index("--") + 1]
if bpy.app.version < (4, 2, 0):
    done = bpy.ops.preferences.addon_install(filepath=zip_file)
else:
    done = bpy.ops.extensions.package_install_files(filepath=zip_file, repo="user_default", enable_on_install=False)
assert done == {"FINISHED"}, done
