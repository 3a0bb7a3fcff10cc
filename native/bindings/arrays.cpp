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

std::vector<int> integers(const py::array& array, const char* name) {
  const auto values = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>::ensure(array);
  std::vector<int> out(static_cast<std::size_t>(array.size()));
  for (std::size_t i = 0; i < out.size(); ++i) {
    const std::int64_t value = values.data()[i];
    if (value < std::numeric_limits<int>::min() || value > std::numeric_limits<int>::max()) {
      refuse(std::string(name) + "[" + std::to_string(i) + "] is out of range");
    }
    out[i] = static_cast<int>(value);
  }
  return out;
}

std::vector<int> to_indices(const py::object& object, const char* name) {
  const py::array array = any_array(object, name);
  const char kind = array.dtype().kind();
  if (kind != 'i' && kind != 'u' && array.size() > 0) refuse(std::string(name) + " must hold integers");
  if (array.ndim() != 1) refuse(std::string(name) + " must have shape (n,), not " + shape_text(array));
  return integers(array, name);
}

/// An array of an option: of one of the kinds (NumPy's letters), with `columns` columns, or flat where that is 0.
py::array option_array(const py::object& object, const std::string& name, const char* kinds, int columns) {
  const auto bad_option = [&](const std::string& message) {
    return RefineError(ErrorCode::BadOption, "options", name + message);
  };
  py::array array = py::array::ensure(object);
  if (!array) {
    PyErr_Clear();
    throw bad_option(" is not an array");
  }
  if (array.size() == 0) return array;
  if (std::string(kinds).find(array.dtype().kind()) == std::string::npos)
    throw bad_option(*kinds == 'f' ? " must hold numbers" : *kinds == 'b' ? " must hold flags" : " must hold integers");
  const bool fits = columns == 0 ? array.ndim() == 1 : array.ndim() == 2 && array.shape(1) == columns;
  if (!fits)
    throw bad_option(" must have shape " + (columns == 0 ? std::string("(faces,)") : "(n, " + std::to_string(columns) + ")") +
                     ", not " + shape_text(array));
  return array;
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

std::vector<double> to_weights(const py::object& object, const std::string& name) {
  const py::array array = option_array(object, name, "fiu", 0);
  const auto values = py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(array);
  return {values.data(), values.data() + values.size()};
}

std::vector<char> to_flags(const py::object& object, const std::string& name) {
  const py::array array = option_array(object, name, "biu", 0);
  const auto values = py::array_t<bool, py::array::c_style | py::array::forcecast>::ensure(array);
  return {values.data(), values.data() + values.size()};
}

std::vector<int> to_numbers(const py::object& object, const std::string& name) {
  return integers(option_array(object, name, "iu", 0), name.c_str());
}

std::vector<std::array<int, 2>> to_edges(const py::object& object, const std::string& name) {
  const std::vector<int> ends = integers(option_array(object, name, "iu", 2), name.c_str());
  std::vector<std::array<int, 2>> out(ends.size() / 2);
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = {ends[2 * i], ends[2 * i + 1]};
  return out;
}

std::vector<std::array<int, 3>> to_triangles(const py::object& object, const std::string& name) {
  const std::vector<int> corners = integers(option_array(object, name, "iu", 3), name.c_str());
  std::vector<std::array<int, 3>> out(corners.size() / 3);
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = {corners[3 * i], corners[3 * i + 1], corners[3 * i + 2]};
  return out;
}

std::vector<Vec2> to_points(const py::object& object, const std::string& name) {
  const auto values =
      py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(option_array(object, name, "fiu", 2));
  std::vector<Vec2> out(static_cast<std::size_t>(values.size()) / 2);
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = Vec2(values.data()[2 * i], values.data()[2 * i + 1]);
  return out;
}

py::array_t<double> to_array(const std::vector<Vec2>& uvs) {
  return table<double>(uvs.size(), 2, [&](std::size_t row, int column) { return uvs[row][column]; });
}

py::array_t<std::int32_t> to_array(const std::vector<int>& indices) {
  return py::array_t<std::int32_t>(static_cast<py::ssize_t>(indices.size()), indices.data());
}

}  // namespace atlas_refine::python
