# SPDX-License-Identifier: GPL-3.0-or-later
"""The engine, from the package that lies in native/."""

import sys

try:
    from .native import atlas_refine
except ImportError as error:
    built_for = "this add-on's engine does not load on Python {}.{}".format(*sys.version_info)
    raise ImportError(f"Atlas Refine: {built_for}: {error}") from error

AtlasRefineError = atlas_refine.AtlasRefineError
start = atlas_refine.start
