// The library's results and its error as Python classes.
#pragma once

#include <pybind11/pybind11.h>

namespace atlas_refine::python {

/// AtlasRefineError with the attributes code, stage, chart and face.
void bind_error(pybind11::module_& module);

/// Measures, Validity, Gap, ChartReport, PieceReport, Progress, CutMesh, RectangleReport and RefineResult, all read-only.
void bind_results(pybind11::module_& module);

}  // namespace atlas_refine::python
