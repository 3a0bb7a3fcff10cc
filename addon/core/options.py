# SPDX-License-Identifier: GPL-3.0-or-later
"""What the artist asked for, in the engine's words."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Options:
    pe_bound: float = 0.8
    seams: str = "NONE"  # NONE or RECTANGLES
    cut: str = "EDGES"  # EDGES or SPLIT: along the mesh's edges, or across faces
    open_closed: bool = True
    stacks: str = "KEEP"  # KEEP or SEPARATE
    sigma: float = 0.004  # of RECTANGLES
    aspect: str = "FREE"  # FREE or SQUARE
    density: str = "KEEP"  # KEEP or EQUAL
    gap: str = "AUTO"  # AUTO or PIXELS
    gap_px: float = 4.0
    texture_size: int = 2048
    seed: int = 1
    best_effort: bool = False

    def engine_arguments(self):
        """Keywords of atlas_refine.start(), for UVs that are stored as float32."""
        arguments = {
            "pe_bound": round(self.pe_bound, 6),  # Blender's properties are float32: 0.8 arrives as 0.800000012
            "box_aspect": 1.0 if self.aspect == "SQUARE" else 0.0,
            "seams": self.seams.lower(),
            "cut": self.cut.lower(),
            "open_closed": self.open_closed,
            "stacks": self.stacks.lower(),
            "density": self.density.lower(),
            "seed": self.seed,
            "best_effort": self.best_effort,
            "stored": "float32",
        }
        if self.seams == "RECTANGLES":
            arguments["sigma"] = round(self.sigma, 6)
        if self.gap == "PIXELS":
            arguments.update(gap=self.gap_px / self.texture_size, gap_unit="long_side")
        return arguments
