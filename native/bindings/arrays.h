// NumPy arrays to the library's Atlas and back.
#pragma once

#include <pybind11/numpy.h>

#include <array>
#include <cstdint>
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

/// Arrays of options, empty ones of any shape: one number, flag or whole number per face; pairs of vertices; triples of corners;
/// points. Throw RefineError(BadOption) for another kind or shape.
std::vector<double> to_weights(const pybind11::object& object, const std::string& name);
std::vector<char> to_flags(const pybind11::object& object, const std::string& name);
std::vector<int> to_numbers(const pybind11::object& object, const std::string& name);
std::vector<std::array<int, 2>> to_edges(const pybind11::object& object, const std::string& name);
std::vector<std::array<int, 3>> to_triangles(const pybind11::object& object, const std::string& name);
std::vector<Vec2> to_points(const pybind11::object& object, const std::string& name);

/// A new (rows, columns) array of what `entry(row, column)` gives.
template <typename Number, typename Entry>
pybind11::array_t<Number> table(std::size_t rows, int columns, Entry entry) {
  pybind11::array_t<Number> array({static_cast<pybind11::ssize_t>(rows), static_cast<pybind11::ssize_t>(columns)});
  auto cells = array.template mutable_unchecked<2>();
  for (std::size_t row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) cells(static_cast<pybind11::ssize_t>(row), column) = entry(row, column);
  }
  return array;
}

/// A new (n, 2) float64 array.
pybind11::array_t<double> to_array(const std::vector<Vec2>& uvs);

/// A new (n,) int32 array.
pybind11::array_t<std::int32_t> to_array(const std::vector<int>& indices);

}  // namespace atlas_refine::python
