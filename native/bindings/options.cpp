// Keyword arguments to RefineOptions.
#include "options.h"

#include <pybind11/stl.h>

#include <cstdint>
#include <functional>
#include <initializer_list>
#include <map>
#include <utility>
#include <vector>

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
Value choice(const py::handle& object, const std::string& keyword, const std::vector<std::pair<const char*, Value>>& choices) {
  const auto word = read<std::string>(object, keyword, "a string");
  std::string known;
  for (const auto& [name, value] : choices) {
    if (word == name) return value;
    known += (known.empty() ? "\"" : ", \"") + std::string(name) + "\"";
  }
  throw RefineError(ErrorCode::BadOption, "options", keyword + " must be one of " + known + ", not \"" + word + "\"");
}

using Reader = std::function<void(Keywords&, const py::handle&, const std::string&)>;

/// Reads an option of one value per face, per edge, ... with `convert`; None leaves it empty.
template <typename Value>
Reader array_reader(Value RefineOptions::*member, Value (*convert)(const py::object&, const std::string&)) {
  return [=](Keywords& keywords, const py::handle& object, const std::string& keyword) {
    if (!object.is_none()) keywords.options.*member = convert(py::reinterpret_borrow<py::object>(object), keyword);
  };
}

Reader numbers_reader(std::vector<double> RefineOptions::*member) {
  return [=](Keywords& keywords, const py::handle& object, const std::string& keyword) {
    if (!object.is_none()) keywords.options.*member = read<std::vector<double>>(object, keyword, "a list of numbers");
  };
}

Reader flag_reader(bool RefineOptions::*member) {
  return [=](Keywords& keywords, const py::handle& object, const std::string& keyword) {
    keywords.options.*member = read<bool>(object, keyword, "True or False");
  };
}

/// None: no limit.
Reader limit_reader(std::optional<double> RefineOptions::*member) {
  return [=](Keywords& keywords, const py::handle& object, const std::string& keyword) {
    if (!object.is_none()) keywords.options.*member = number(object, keyword);
  };
}

template <typename Value>
Reader choice_reader(Value RefineOptions::*member, std::initializer_list<std::pair<const char*, Value>> choices) {
  const std::vector<std::pair<const char*, Value>> known(choices);
  return [=](Keywords& keywords, const py::handle& object, const std::string& keyword) {
    keywords.options.*member = choice<Value>(object, keyword, known);
  };
}

/// What happens to charts that are not like the others, and what is kept as it is.
void add_chart_readers(std::map<std::string, Reader>& table) {
  table["cut"] = choice_reader<Cut>(&RefineOptions::cut, {{"split", Cut::Split}, {"edges", Cut::Edges}});
  table["open_closed"] = flag_reader(&RefineOptions::open_closed);
  table["stacks"] = choice_reader<Stacks>(&RefineOptions::stacks, {{"keep", Stacks::Keep}, {"separate", Stacks::Separate}});
  table["collapsed"] =
      choice_reader<Collapsed>(&RefineOptions::collapsed, {{"leave", Collapsed::Leave}, {"embed", Collapsed::Embed}});
  table["rotate"] =
      choice_reader<Rotate>(&RefineOptions::rotate, {{"any", Rotate::Any}, {"90", Rotate::QuarterTurns}, {"none", Rotate::None}});
  table["align_axes"] = flag_reader(&RefineOptions::align_axes);
  table["triangulate"] = flag_reader(&RefineOptions::triangulate);
  table["groups"] = array_reader(&RefineOptions::groups, &to_numbers);
  table["stack_groups"] = array_reader(&RefineOptions::stack_groups, &to_numbers);
  table["group_origins"] = array_reader(&RefineOptions::group_origins, &to_points);
  table["group_aspects"] = numbers_reader(&RefineOptions::group_aspects);
  table["group_densities"] = numbers_reader(&RefineOptions::group_densities);
  table["group_gaps"] = numbers_reader(&RefineOptions::group_gaps);
  table["group_names"] = [](Keywords& k, const py::handle& v, const std::string& s) {
    if (!v.is_none()) k.options.group_names = read<std::vector<std::string>>(v, s, "a list of strings");
  };
  table["keep_shape"] = array_reader(&RefineOptions::keep_shape, &to_flags);
  table["locked"] = array_reader(&RefineOptions::locked, &to_flags);
  table["no_seam"] = array_reader(&RefineOptions::no_seam, &to_edges);
  table["prefer_seam"] = array_reader(&RefineOptions::prefer_seam, &to_edges);
  table["triangles"] = [](Keywords& k, const py::handle& v, const std::string& s) {
    if (!v.is_none()) k.triangles = to_triangles(py::reinterpret_borrow<py::object>(v), s);
  };
}

/// Where seams may come from, and what needed ones are asked.
void add_needed_readers(std::map<std::string, Reader>& table) {
  using H = const py::handle&;
  using S = const std::string&;
  table["seams"] = choice_reader<Seams>(&RefineOptions::seams,
                                        {{"none", Seams::None}, {"needed", Seams::Needed}, {"rectangles", Seams::Rectangles}});
  table["effort"] =
      choice_reader<Effort>(&RefineOptions::effort, {{"fast", Effort::Fast}, {"normal", Effort::Normal}, {"best", Effort::Best}});
  table["trade_off"] = flag_reader(&RefineOptions::trade_off);
  table.merge(std::map<std::string, Reader>{
      {"max_boundary_growth", limit_reader(&RefineOptions::max_boundary_growth)},
      {"seam_cost", [](Keywords& k, H v, S s) { k.options.seam_cost = number(v, s); }},
      {"point",
       [](Keywords& k, H v, S s) {
         if (!v.is_none()) k.options.point = read<int>(v, s, "a whole number");
       }},
  });
}

std::map<std::string, Reader> make_readers() {
  using H = const py::handle&;
  using S = const std::string&;
  std::map<std::string, Reader> table = {
      {"pe_bound", [](Keywords& k, H v, S s) { k.options.pe_bound = number(v, s); }},
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
         if (!v.is_none()) k.options.importance = to_weights(py::reinterpret_borrow<py::object>(v), s);
       }},
      {"box_aspect", [](Keywords& k, H v, S s) { k.options.box_aspect = number(v, s); }},
      {"in_texture", flag_reader(&RefineOptions::in_texture)},
      {"gap",
       [](Keywords& k, H v, S s) {
         if (!v.is_none()) k.options.gap = Gap{number(v, s), Gap::Unit::BoxDiagonal};
       }},
      {"max_distortion", limit_reader(&RefineOptions::max_distortion)},
      {"max_stretch", limit_reader(&RefineOptions::max_stretch)},
      {"relax", [](Keywords& k, H v, S s) { k.options.relax = read<bool>(v, s, "True or False"); }},
      {"best_effort", [](Keywords& k, H v, S s) { k.options.best_effort = read<bool>(v, s, "True or False"); }},
      {"density",
       [](Keywords& k, H v, S s) {
         k.options.density = choice<Density>(v, s, {{"equal", Density::Equal}, {"keep", Density::Keep}});
       }},
      {"uv_density", [](Keywords& k, H v, S s) { k.options.uv_density = number(v, s); }},
      {"stored",
       [](Keywords& k, H v, S s) {
         k.options.stored = choice<Stored>(v, s, {{"double", Stored::Double}, {"float32", Stored::Float32}});
       }},
      {"seed", [](Keywords& k, H v, S s) { k.options.seed = read<std::uint64_t>(v, s, "a whole number of at least 0"); }},
      {"threads", [](Keywords& k, H v, S s) { k.options.threads = read<int>(v, s, "a whole number"); }},
      {"progress", [](Keywords& k, H v, S) { k.progress = py::reinterpret_borrow<py::object>(v); }},
      {"name", [](Keywords& k, H v, S s) { k.name = read<std::string>(v, s, "a string"); }},
  };
  add_chart_readers(table);
  add_needed_readers(table);
  return table;
}

const std::map<std::string, Reader>& readers() {
  static const std::map<std::string, Reader> table = make_readers();
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
