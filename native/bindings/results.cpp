// The library's results and its error as Python classes.
#include "results.h"

#include <pybind11/stl.h>

#include <cmath>
#include <exception>
#include <sstream>
#include <utility>

#include "arrays.h"
#include "atlas_refine/refine.h"

namespace py = pybind11;

namespace atlas_refine::python {
namespace {

constexpr const char* kErrorDoc =
    R"(Why a call failed, in one line.

code   "bad_option", "bad_input", "bound_not_reached", "not_certified" or "cancelled"
stage  the stage that failed, for example "input" or "squeeze"
chart  0-based index of the chart, -1 where none applies
face   0-based index of the input face, -1 where none applies)";

PyObject* g_error_type = nullptr;

void set_error(const RefineError& error) {
  py::object instance = py::reinterpret_borrow<py::object>(g_error_type)(error.what());
  instance.attr("code") = to_string(error.code());
  instance.attr("stage") = error.stage();
  instance.attr("chart") = error.chart();
  instance.attr("face") = error.face();
  PyErr_SetObject(g_error_type, instance.ptr());
}

/// "Name(field=value, ...)" for every property that the class has.
py::str describe(const py::object& self) {
  const py::object type = py::type::of(self);
  std::ostringstream text;
  text << py::str(type.attr("__name__")).cast<std::string>() << "(";
  const char* separator = "";
  for (const auto& field : type.attr("_fields")) {
    text << separator << field.cast<std::string>() << "=" << py::repr(self.attr(field)).cast<std::string>();
    separator = ", ";
  }
  text << ")";
  return py::str(text.str());
}

/// A property's value as json.dumps() takes it.
py::object plain(const py::handle& value) {
  if (py::hasattr(value, "as_dict")) return value.attr("as_dict")();
  if (py::isinstance<py::array>(value)) return value.attr("tolist")();
  if (py::isinstance<py::float_>(value) && !std::isfinite(value.cast<double>())) return py::none();
  if (!py::isinstance<py::list>(value)) return py::reinterpret_borrow<py::object>(value);
  py::list entries;
  for (const auto& entry : value) entries.append(plain(entry));
  return entries;
}

py::dict as_dict(const py::object& self) {
  py::dict fields;
  for (const auto& field : py::type::of(self).attr("_fields")) fields[field] = plain(self.attr(field));
  return fields;
}

/// A read-only value class whose fields are listed once; repr() and as_dict() follow from the list.
template <typename Value>
class ValueClass {
 public:
  ValueClass(py::module_& module, const char* name, const char* doc) : class_(module, name, py::module_local(), doc) {
    class_.def("__repr__", &describe)
        .def("as_dict", &as_dict, "All fields in a new dict as json.dumps() takes them: arrays as lists, infinity as None.");
  }
  ~ValueClass() { class_.attr("_fields") = py::tuple(fields_); }

  template <typename Member>
  ValueClass& field(const char* name, Member member) {
    fields_.append(name);
    class_.def_readonly(name, member);
    return *this;
  }

  template <typename Getter>
  ValueClass& property(const char* name, Getter getter) {
    fields_.append(name);
    class_.def_property_readonly(name, getter);
    return *this;
  }

 private:
  py::class_<Value> class_;
  py::list fields_;
};

void bind_measures(py::module_& module) {
  ValueClass<Measures>(module, "Measures", "Figures of one atlas; each field is explained in the package's type stub.")
      .field("pe", &Measures::pe)
      .field("pe_fixed_aspect", &Measures::pe_fixed_aspect)
      .field("box_width", &Measures::box_width)
      .field("box_height", &Measures::box_height)
      .field("unit_square_share", &Measures::unit_square_share)
      .field("boundary_length", &Measures::boundary_length)
      .field("seam_edges", &Measures::seam_edges)
      .field("chart_count", &Measures::chart_count)
      .field("smallest_chart", &Measures::smallest_chart)
      .field("small_charts", &Measures::small_charts)
      .field("distortion", &Measures::distortion)
      .field("distortion_to_input", &Measures::distortion_to_input)
      .field("stretch_99", &Measures::stretch_99)
      .field("stretch_max", &Measures::stretch_max)
      .field("gap_between", &Measures::gap_between)
      .field("gap_within", &Measures::gap_within);
  ValueClass<Triangulations>(module, "Triangulations", "Faces that are not positive however they are divided.")
      .field("fan_flipped", &Triangulations::fan_flipped)
      .field("ears_flipped", &Triangulations::ears_flipped)
      .field("not_convex", &Triangulations::not_convex);
  ValueClass<Validity>(module, "Validity", "Whether an atlas is valid, and the first problem if it is not.")
      .property("valid", &Validity::valid)
      .field("problem", &Validity::problem)
      .field("chart", &Validity::chart)
      .field("face", &Validity::face)
      .field("flipped_faces", &Validity::flipped_faces)
      .field("mirrored_charts", &Validity::mirrored_charts)
      .field("crossings", &Validity::crossings)
      .field("triangulations", &Validity::triangulations);
}

void bind_cut_mesh(py::module_& module) {
  ValueClass<CutMesh>(module, "CutMesh", "The mesh after cutting: its faces, the new vertices, where both come from, new seams.")
      .property("face_offsets", [](const CutMesh& m) { return to_array(m.face_offsets); })
      .property("corner_vertices", [](const CutMesh& m) { return to_array(m.corner_vertices); })
      .property("face_sources", [](const CutMesh& m) { return to_array(m.face_sources); })
      .property("corner_sources",
                [](const CutMesh& m) {
                  const auto& sources = m.corner_sources;
                  return table<std::int32_t>(sources.size(), 3, [&](std::size_t i, int k) { return sources[i][k]; });
                })
      .property("corner_weights",
                [](const CutMesh& m) {
                  const auto& weights = m.corner_weights;
                  return table<double>(weights.size(), 3, [&](std::size_t i, int k) { return weights[i][k]; });
                })
      .property("new_vertex_corners",
                [](const CutMesh& m) {
                  const auto& vertices = m.new_vertices;
                  return table<std::int32_t>(vertices.size(), 3, [&](std::size_t i, int k) { return vertices[i].corners[k]; });
                })
      .property("new_vertex_weights",
                [](const CutMesh& m) {
                  const auto& vertices = m.new_vertices;
                  return table<double>(vertices.size(), 3, [&](std::size_t i, int k) { return vertices[i].weights[k]; });
                })
      .property("new_seams", [](const CutMesh& m) {
        return table<std::int32_t>(m.new_seams.size(), 2, [&](std::size_t i, int k) { return m.new_seams[i][k]; });
      });
}

void bind_rectangle_report(py::module_& module) {
  ValueClass<RectangleReport>(module, "RectangleReport", "How the paper's road went; each field is explained in the type stub.")
      .field("tutte_charts", &RectangleReport::tutte_charts)
      .field("boxed_charts", &RectangleReport::boxed_charts)
      .field("holes_cut", &RectangleReport::holes_cut)
      .field("extra_corners", &RectangleReport::extra_corners)
      .field("trails", &RectangleReport::trails)
      .field("packed_pe", &RectangleReport::packed_pe);
}

void bind_cut_report(py::module_& module) {
  ValueClass<TradeOff>(module, "TradeOff", "Boundary against distortion: one outcome of the search for cuts.")
      .field("boundary_growth", &TradeOff::boundary_growth)
      .field("distortion", &TradeOff::distortion)
      .field("cuts", &TradeOff::cuts);
  ValueClass<CutReport>(module, "CutReport", "How the search for cuts went; each field is explained in the type stub.")
      .field("cuts", &CutReport::cuts)
      .field("tried", &CutReport::tried)
      .field("trade_off", &CutReport::trade_off)
      .field("chosen", &CutReport::chosen);
}

void bind_chart_reports(py::module_& module) {
  ValueClass<ChartReport>(module, "ChartReport", "One chart of the input, and what it went through.")
      .field("faces", &ChartReport::faces)
      .field("area", &ChartReport::area)
      .field("mirrored", &ChartReport::mirrored)
      .field("re_embedded", &ChartReport::re_embedded)
      .property("fate", [](const ChartReport& c) { return to_string(c.fate); })
      .field("reason", &ChartReport::reason)
      .field("stacked_on", &ChartReport::stacked_on)
      .field("distortion_before", &ChartReport::distortion_before)
      .field("distortion_after", &ChartReport::distortion_after)
      .field("stretch_max", &ChartReport::stretch_max)
      .field("density_before", &ChartReport::density_before)
      .field("density_after", &ChartReport::density_after);
  ValueClass<PieceReport>(module, "PieceReport", "One chart of the output, where charts were cut.")
      .field("chart", &PieceReport::chart)
      .field("faces", &PieceReport::faces)
      .field("area", &PieceReport::area)
      .field("distortion", &PieceReport::distortion)
      .field("stretch_max", &PieceReport::stretch_max);
}

void bind_repairs_and_groups(py::module_& module) {
  ValueClass<Repair>(module, "Repair", "What was mended in charts before they were refined.")
      .field("what", &Repair::what)
      .field("charts", &Repair::charts)
      .field("faces", &Repair::faces)
      .field("distortion_to_input", &Repair::distortion_to_input)
      .property("text", [](const Repair& repair) { return describe(repair); });
  ValueClass<GroupReport>(module, "GroupReport", "One atlas of several.")
      .field("group", &GroupReport::group)
      .field("name", &GroupReport::name)
      .field("charts", &GroupReport::charts)
      .property("intervention", [](const GroupReport& group) { return to_string(group.intervention); })
      .field("bound_met", &GroupReport::bound_met)
      .field("reason", &GroupReport::reason)
      .field("before", &GroupReport::before)
      .field("after", &GroupReport::after)
      .field("gap", &GroupReport::gap);
}

void bind_profile(py::module_& module) {
  ValueClass<Profile>(module, "Profile", "Where the time of a call went, and how its steps did.")
      .property("phases",
                [](const Profile& profile) {
                  py::dict seconds;
                  for (const PhaseTime& time : profile.phases) seconds[py::str(time.phase)] = time.seconds;
                  return seconds;
                })
      .field("steps", &Profile::steps)
      .field("mean_step", &Profile::mean_step);
}

void bind_refine_result(py::module_& module) {
  ValueClass<RefineResult>(module, "RefineResult", "A refined atlas with its certificate's figures.")
      .property("corner_uvs", [](const RefineResult& r) { return to_array(r.corner_uvs); })
      .field("cut", &RefineResult::cut)
      .property("intervention", [](const RefineResult& r) { return to_string(r.intervention); })
      .field("bound_met", &RefineResult::bound_met)
      .field("before", &RefineResult::before)
      .field("after", &RefineResult::after)
      .field("added_seams", &RefineResult::added_seams)
      .field("boundary_growth", &RefineResult::boundary_growth)
      .property("new_seams",
                [](const RefineResult& r) {
                  return table<std::int32_t>(r.new_seams.size(), 2, [&](std::size_t i, int k) { return r.new_seams[i][k]; });
                })
      .field("triangulations", &RefineResult::triangulations)
      .field("gap", &RefineResult::gap)
      .field("price", &RefineResult::price)
      .field("iterations", &RefineResult::iterations)
      .property("ended", [](const RefineResult& r) { return to_string(r.ended); })
      .field("charts", &RefineResult::charts)
      .property("face_charts", [](const RefineResult& r) { return to_array(r.face_charts); })
      .field("pieces", &RefineResult::pieces)
      .field("rectangles", &RefineResult::rectangles)
      .field("cuts", &RefineResult::cuts)
      .field("groups", &RefineResult::groups)
      .field("repairs", &RefineResult::repairs)
      .field("fallbacks", &RefineResult::fallbacks)
      .field("warnings", &RefineResult::warnings)
      .property("timings",
                [](const RefineResult& r) {
                  py::dict seconds;
                  for (const StageTime& time : r.timings) seconds[py::str(time.stage)] = time.seconds;
                  return seconds;
                })
      .field("profile", &RefineResult::profile);
}

}  // namespace

void bind_error(py::module_& module) {
  g_error_type = PyErr_NewExceptionWithDoc("atlas_refine.AtlasRefineError", kErrorDoc, PyExc_RuntimeError, nullptr);
  if (g_error_type == nullptr) throw py::error_already_set();
  module.attr("AtlasRefineError") = py::reinterpret_borrow<py::object>(g_error_type);
  py::register_local_exception_translator(
      [](std::exception_ptr error) {  // NOLINT(performance-unnecessary-value-param): the signature is pybind11's
        try {
          if (error) std::rethrow_exception(error);
        } catch (const RefineError& refine_error) {
          set_error(refine_error);
        }
      });
}

void bind_results(py::module_& module) {
  ValueClass<Progress>(module, "Progress", "Where a running call is: stage, fraction of the whole in [0, 1], present PE or 0.")
      .field("stage", &Progress::stage)
      .field("fraction", &Progress::fraction)
      .field("pe", &Progress::pe);
  ValueClass<Gap>(module, "Gap", "The smallest distance between two charts that is guaranteed.")
      .field("value", &Gap::value)
      .property("unit", [](const Gap& gap) { return gap.unit == Gap::Unit::LongSide ? "long_side" : "diagonal"; });
  bind_chart_reports(module);
  bind_measures(module);
  bind_cut_mesh(module);
  bind_rectangle_report(module);
  bind_cut_report(module);
  bind_repairs_and_groups(module);
  bind_profile(module);
  bind_refine_result(module);
}

}  // namespace atlas_refine::python
