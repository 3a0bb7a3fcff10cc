# SPDX-License-Identifier: GPL-3.0-or-later
"""Every difference between the Blender versions that the add-on runs on, told apart by features."""

import numpy as np


def read_uvs(layer, corner_count):
    """The layer's UVs as (corner_count, 2) float32."""
    uvs = np.empty(2 * corner_count, dtype=np.float32)
    if hasattr(layer, "uv"):  # 3.5 and later
        layer.uv.foreach_get("vector", uvs)
    else:
        layer.data.foreach_get("uv", uvs)
    return uvs.reshape(-1, 2)


def write_uvs(layer, uvs):
    """Stores (C, 2) float32; pins and selection stay."""
    if hasattr(layer, "uv"):  # 3.5 and later
        layer.uv.foreach_set("vector", uvs.ravel())
    else:
        layer.data.foreach_set("uv", uvs.ravel())


def progress_bar(layout, fraction, text):
    if hasattr(layout, "progress"):  # 4.0 and later
        layout.progress(factor=fraction, text=text)
    else:
        layout.label(text=f"{text}: {100 * fraction:.0f} %", icon="SORTTIME")
