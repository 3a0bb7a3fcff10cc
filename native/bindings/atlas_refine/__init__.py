"""Atlas Refine: brings a UV atlas to a packing efficiency bound.

    result = atlas_refine.refine(positions, face_offsets, corner_vertices, corner_uvs, pe_bound=0.85)
    result.corner_uvs      # (C, 2) float64, replaces the input's

    result = atlas_refine.refine(positions, face_offsets, corner_vertices, corner_uvs, seams="rectangles")
    result.cut             # the divided mesh that the UVs belong to, None where no face was divided

Arrays in and out are NumPy's; help(atlas_refine.refine) lists shapes, units, options and errors.
"""

from ._atlas_refine import (
    AtlasRefineError,
    ChartReport,
    CutMesh,
    CutReport,
    Gap,
    GroupReport,
    Job,
    Measures,
    PieceReport,
    Profile,
    Progress,
    RectangleReport,
    RefineResult,
    Repair,
    TradeOff,
    Triangulations,
    Validity,
    __version__,
    charts_of_faces,
    find_problems,
    group_by_tile,
    measure,
    refine,
    start,
    validate,
)
from .packing import packing_curve

__all__ = [
    "AtlasRefineError",
    "ChartReport",
    "CutMesh",
    "CutReport",
    "Gap",
    "GroupReport",
    "Job",
    "Measures",
    "PieceReport",
    "Profile",
    "Progress",
    "RectangleReport",
    "RefineResult",
    "Repair",
    "TradeOff",
    "Triangulations",
    "Validity",
    "__version__",
    "charts_of_faces",
    "find_problems",
    "group_by_tile",
    "measure",
    "packing_curve",
    "refine",
    "start",
    "validate",
]
