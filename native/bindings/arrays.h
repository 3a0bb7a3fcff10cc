// NumPy arrays to the library's Atlas and back.
#pragma once

#include <pybind11/numpy.h>

#include <string>
#include <vector>

#include "atlas_refine/atlas.h"

namespace atlas_refine::python {

/// The four array arguments that every call of the module starts with.
struct AtlasArrays {
  pybind11::object positions;        ///< (V, 3) numbers
  pybind11::object face_offsets;     ///< (F + 1,) integers
  pybind11::object corner_vertices;  ///< (C,) integers
  pybind11::object corner_uvs;       ///< (C, 2) numbers
};

/// Copies the arrays. Throws RefineError(BadInput) that names the array whose shape or type does not fit.
Atlas to_atlas(const AtlasArrays& arrays, std::string name);

/// A new (n, 2) float64 array.
pybind11::array_t<double> to_array(const std::vector<Vec2>& uvs);

}  // namespace atlas_refine::python
