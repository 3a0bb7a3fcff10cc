// NumPy arrays to the library's Atlas and back.
#include "arrays.h"

#include <cstdint>
#include <limits>
#include <utility>

#include "atlas_refine/error.h"

namespace py = pybind11;

namespace atlas_refine::python {
namespace {

[[noreturn]] void refuse(const std::string& message) { throw RefineError(ErrorCode::BadInput, "input", message); }

std::string shape_text(const py::array& array) { return py::str(array.attr("shape")); }

py::array any_array(const py::object& object, const char* name) {
  py::array array = py::array::ensure(object);
  if (!array) {
    PyErr_Clear();
    refuse(std::string(name) + " is not an array");
  }
  return array;
}

/// Rows of `columns` numbers as Eigen vectors, which lie in memory as the rows do.
template <typename Row>
std::vector<Row> to_rows(const py::object& object, const char* name, int columns) {
  const py::array array = any_array(object, name);
  const char kind = array.dtype().kind();
  if (kind != 'f' && kind != 'i' && kind != 'u') refuse(std::string(name) + " must hold numbers");
  if (array.ndim() != 2 || array.shape(1) != columns) {
    refuse(std::string(name) + " must have shape (n, " + std::to_string(columns) + "), not " + shape_text(array));
  }
  const auto values = py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(array);
  std::vector<Row> rows(static_cast<std::size_t>(array.shape(0)));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (int k = 0; k < columns; ++k) rows[i][k] = values.at(static_cast<py::ssize_t>(i), k);
  }
  return rows;
}

std::vector<int> to_indices(const py::object& object, const char* name) {
  const py::array array = any_array(object, name);
  const char kind = array.dtype().kind();
  if (kind != 'i' && kind != 'u' && array.size() > 0) refuse(std::string(name) + " must hold integers");
  if (array.ndim() != 1) refuse(std::string(name) + " must have shape (n,), not " + shape_text(array));
  const auto values = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>::ensure(array);
  std::vector<int> indices(static_cast<std::size_t>(array.shape(0)));
  for (std::size_t i = 0; i < indices.size(); ++i) {
    const std::int64_t value = values.at(static_cast<py::ssize_t>(i));
    if (value < std::numeric_limits<int>::min() || value > std::numeric_limits<int>::max()) {
      refuse(std::string(name) + "[" + std::to_string(i) + "] is out of range");
    }
    indices[i] = static_cast<int>(value);
  }
  return indices;
}

}  // namespace

Atlas to_atlas(const AtlasArrays& arrays, std::string name) {
  Atlas atlas;
  atlas.name = std::move(name);
  atlas.positions = to_rows<Vec3>(arrays.positions, "positions", 3);
  atlas.face_offsets = to_indices(arrays.face_offsets, "face_offsets");
  atlas.corner_vertices = to_indices(arrays.corner_vertices, "corner_vertices");
  atlas.corner_uvs = to_rows<Vec2>(arrays.corner_uvs, "corner_uvs", 2);
  return atlas;
}

std::vector<double> to_weights(const py::object& object, const char* name) {
  const auto bad_option = [&](const std::string& message) {
    return RefineError(ErrorCode::BadOption, "options", std::string(name) + message);
  };
  const py::array array = py::array::ensure(object);
  if (!array) {
    PyErr_Clear();
    throw bad_option(" is not an array");
  }
  const char kind = array.dtype().kind();
  if (kind != 'f' && kind != 'i' && kind != 'u') throw bad_option(" must hold numbers");
  if (array.ndim() != 1) throw bad_option(" must have shape (faces,), not " + shape_text(array));
  const auto values = py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(array);
  return {values.data(), values.data() + values.size()};
}

py::array_t<double> to_array(const std::vector<Vec2>& uvs) {
  return table<double>(uvs.size(), 2, [&](std::size_t row, int column) { return uvs[row][column]; });
}

py::array_t<std::int32_t> to_array(const std::vector<int>& indices) {
  return py::array_t<std::int32_t>(static_cast<py::ssize_t>(indices.size()), indices.data());
}

}  // namespace atlas_refine::python
