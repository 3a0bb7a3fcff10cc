# SPDX-License-Identifier: GPL-3.0-or-later
"""The engine, from the package that lies in native/."""

import sys

try:
    from .native import atlas_refine as module
except ImportError as error:
    built_for = "this add-on's engine does not load on Python {}.{}".format(*sys.version_info)
    raise ImportError(f"Atlas Refine: {built_for}: {error}", name=error.name) from error

AtlasRefineError = module.AtlasRefineError
start = module.start
measure = module.measure
