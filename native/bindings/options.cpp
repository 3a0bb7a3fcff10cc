// Keyword arguments to RefineOptions.
#include "options.h"

#include <cstdint>
#include <functional>
#include <initializer_list>
#include <map>
#include <utility>

#include "arrays.h"

namespace py = pybind11;

namespace atlas_refine::python {
namespace {

template <typename Value>
Value read(const py::handle& object, const std::string& keyword, const char* expected) {
  try {
    return object.cast<Value>();
  } catch (const py::cast_error&) {
    throw py::type_error(keyword + " must be " + expected + ", not " +
                         py::str(py::type::of(object).attr("__name__")).cast<std::string>());
  }
}

double number(const py::handle& object, const std::string& keyword) { return read<double>(object, keyword, "a number"); }

template <typename Value>
Value choice(const py::handle& object, const std::string& keyword, std::initializer_list<std::pair<const char*, Value>> choices) {
  const auto word = read<std::string>(object, keyword, "a string");
  std::string known;
  for (const auto& [name, value] : choices) {
    if (word == name) return value;
    known += (known.empty() ? "\"" : ", \"") + std::string(name) + "\"";
  }
  throw RefineError(ErrorCode::BadOption, "options", keyword + " must be one of " + known + ", not \"" + word + "\"");
}

using Reader = std::function<void(Keywords&, const py::handle&, const std::string&)>;

const std::map<std::string, Reader>& readers() {
  using H = const py::handle&;
  using S = const std::string&;
  static const std::map<std::string, Reader> table = {
      {"pe_bound", [](Keywords& k, H v, S s) { k.options.pe_bound = number(v, s); }},
      {"seams",
       [](Keywords& k, H v, S s) {
         k.options.seams = choice<Seams>(v, s, {{"none", Seams::None}, {"rectangles", Seams::Rectangles}});
       }},
      {"sigma", [](Keywords& k, H v, S s) { k.options.rectangles.sigma = number(v, s); }},
      {"candidates", [](Keywords& k, H v, S s) { k.options.rectangles.candidates = read<int>(v, s, "a whole number"); }},
      {"omega", [](Keywords& k, H v, S s) { k.options.rectangles.omega = number(v, s); }},
      {"until_input", [](Keywords& k, H v, S s) { k.options.rectangles.until_input = read<bool>(v, s, "True or False"); }},
      {"reference",
       [](Keywords& k, H v, S s) {
         k.options.reference = choice<Reference>(v, s, {{"surface", Reference::Surface}, {"input", Reference::Input}});
       }},
      {"importance",
       [](Keywords& k, H v, S s) {
         if (!v.is_none()) k.options.importance = to_weights(py::reinterpret_borrow<py::object>(v), s.c_str());
       }},
      {"box_aspect", [](Keywords& k, H v, S s) { k.options.box_aspect = number(v, s); }},
      {"gap",
       [](Keywords& k, H v, S s) {
         if (!v.is_none()) k.options.gap = Gap{number(v, s), Gap::Unit::BoxDiagonal};
       }},
      {"max_distortion",
       [](Keywords& k, H v, S s) {
         if (!v.is_none()) k.options.max_distortion = number(v, s);
       }},
      {"relax", [](Keywords& k, H v, S s) { k.options.relax = read<bool>(v, s, "True or False"); }},
      {"best_effort", [](Keywords& k, H v, S s) { k.options.best_effort = read<bool>(v, s, "True or False"); }},
      {"density",
       [](Keywords& k, H v, S s) {
         k.options.density = choice<Density>(v, s, {{"equal", Density::Equal}, {"keep", Density::Keep}});
       }},
      {"stored",
       [](Keywords& k, H v, S s) {
         k.options.stored = choice<Stored>(v, s, {{"double", Stored::Double}, {"float32", Stored::Float32}});
       }},
      {"seed", [](Keywords& k, H v, S s) { k.options.seed = read<std::uint64_t>(v, s, "a whole number of at least 0"); }},
      {"threads", [](Keywords& k, H v, S s) { k.options.threads = read<int>(v, s, "a whole number"); }},
      {"progress", [](Keywords& k, H v, S) { k.progress = py::reinterpret_borrow<py::object>(v); }},
      {"name", [](Keywords& k, H v, S s) { k.name = read<std::string>(v, s, "a string"); }},
  };
  return table;
}

/// gap_unit needs the gap, whichever keyword comes first.
void read_gap_unit(Keywords& keywords, const py::handle& object) {
  const auto unit =
      choice<Gap::Unit>(object, "gap_unit", {{"diagonal", Gap::Unit::BoxDiagonal}, {"long_side", Gap::Unit::LongSide}});
  if (keywords.options.gap) keywords.options.gap->unit = unit;
}

}  // namespace

Keywords read_keywords(const py::kwargs& kwargs, const char* function, const std::string& allowed) {
  Keywords keywords;
  for (const auto& [key, value] : kwargs) {
    const auto keyword = key.cast<std::string>();
    if ((" " + allowed + " ").find(" " + keyword + " ") == std::string::npos) {
      throw py::type_error(std::string(function) + "() got an unexpected keyword argument '" + keyword + "'");
    }
    if (keyword != "gap_unit") readers().at(keyword)(keywords, value, keyword);
  }
  if (kwargs.contains("gap_unit")) read_gap_unit(keywords, kwargs["gap_unit"]);
  if (!keywords.progress.is_none() && !PyCallable_Check(keywords.progress.ptr())) {
    throw py::type_error("progress must be callable or None");
  }
  return keywords;
}

}  // namespace atlas_refine::python
