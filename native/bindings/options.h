// Keyword arguments to RefineOptions.
#pragma once

#include <pybind11/pybind11.h>

#include <string>

#include "atlas_refine/refine.h"

namespace atlas_refine::python {

/// What the keywords of refine(), start(), measure() and validate() can say.
struct Keywords {
  RefineOptions options;
  std::string name;
  std::vector<std::array<int, 3>> triangles;  ///< Atlas::triangles
  pybind11::object progress = pybind11::none();
};

/// Reads the keywords that `allowed` (space separated) names. A keyword that is not among them or holds the wrong type is a
/// TypeError; a word that is none of its choices a RefineError(BadOption). Ranges are the library's to check.
Keywords read_keywords(const pybind11::kwargs& kwargs, const char* function, const std::string& allowed);

}  // namespace atlas_refine::python
