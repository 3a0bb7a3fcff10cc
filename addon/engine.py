# SPDX-License-Identifier: GPL-3.0-or-later
"""The engine, from the package that lies in native/."""

import sys

try:
    from .native import atlas_refine as module
except ImportError as error:
    # With the add-on's name Blender takes it as this add-on's own trouble, in a line instead of a traceback.
    python = "{}.{}".format(*sys.version_info)
    raise ImportError(f"Atlas Refine: the engine does not load on Python {python}: {error}", name=__package__) from error

AtlasRefineError = module.AtlasRefineError
start = module.start
measure = module.measure
