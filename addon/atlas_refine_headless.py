# SPDX-License-Identifier: GPL-3.0-or-later
"""The headless command as a script, where Blender has no --command (before 4.2) and in the bpy module:

blender --background --python .../atlas_refine_addon/atlas_refine_headless.py -- ARGUMENTS
python3 .../atlas_refine/atlas_refine_headless.py -- ARGUMENTS                       (with the bpy module)
"""

import importlib
import os
import pathlib
import sys

import bpy  # the bpy module must come first: it makes addon_utils importable

FOLDER = pathlib.Path(__file__).resolve().parent


def addon_name():
    """The installed add-on that this file belongs to, enabled for this process alone."""
    import addon_utils

    for module in addon_utils.modules():
        if pathlib.Path(module.__file__).resolve().parent == FOLDER:
            is_loaded = addon_utils.check(module.__name__)[1]
            if not is_loaded and addon_utils.enable(module.__name__, persistent=True) is None:
                sys.exit(f"{module.__name__} does not load")
            return module.__name__
    sys.exit(f"{FOLDER} is no add-on that this Blender finds; install the zip first")


def main():
    arguments = sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else []
    code = importlib.import_module(f"{addon_name()}.headless").main(arguments)
    sys.stdout.flush()
    sys.stderr.flush()
    if bpy.app.version[:2] == (4, 2):
        os._exit(code)  # the bpy module 4.2 crashes when Python ends, once any script gave it a function
    sys.exit(code)


if __name__ == "__main__":
    main()
