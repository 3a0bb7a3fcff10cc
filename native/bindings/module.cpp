// The Python module: refine(), start(), measure() and validate() on NumPy arrays.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <exception>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "arrays.h"
#include "atlas_refine/refine.h"
#include "job.h"
#include "options.h"
#include "results.h"

namespace py = pybind11;

namespace atlas_refine::python {
namespace {

const std::string kRefineKeywords =
    "pe_bound seams box_aspect in_texture gap gap_unit max_distortion max_stretch max_boundary_growth seam_cost effort trade_off "
    "point relax best_effort density uv_density stored sigma candidates omega until_input reference importance seed threads name "
    "cut open_closed stacks stack_groups collapsed rotate align_axes triangulate groups group_origins "
    "group_aspects group_gaps group_densities group_names keep_shape locked no_seam prefer_seam triangles";

constexpr const char* kArraysDoc = R"(

positions        (V, 3) float64, model units
face_offsets     (F + 1,) integers, from 0: face f owns corners face_offsets[f] .. face_offsets[f + 1] - 1
corner_vertices  (C,) integers, index into positions
corner_uvs       (C, 2) float64, UV units; equal values at both ends of a shared edge join two faces to one chart
)";

constexpr const char* kRefineOptionsDoc = R"(
pe_bound         packing efficiency to reach, in (0, 1); default 0.8
seams            "none" (default): charts bend, no seam is added; "needed": they bend, and are cut where their distortion is
                 above max_distortion or max_stretch or, without these, where a cut saves what it costs (seam_cost);
                 "rectangles": charts become axis-aligned and are cut into rectangles (Liu et al. 2019). Where faces are divided
                 result.cut is the mesh that corner_uvs belong to
box_aspect       width / height of the texture that [0, 1]^2 stands for, in [0.01, 100]; 0 (default) = a free box, 1 = square.
                 All lengths are taken with u stretched by it
in_texture       the box is the texture itself (square where box_aspect is 0), in the input too: pe_fixed_aspect is what charts cover
                 of it, UVs elsewhere do not hold the bound, and a gap that is given is kept to its border as well; default False
gap              smallest distance between charts as a fraction of gap_unit, hard; None (default) = automatic: the largest of
                 0.0025 of the diagonal and smaller ones, each 0.6 of the one before, with which the bound is reached and its
                 last per cent costs at most 3 % of E_d; result.warnings tells why larger ones were given up
gap_unit         "diagonal" of the box (default) or its "long_side" (N texels of a texture of S: N / S)
max_distortion   largest E_d allowed, on the surface (1 = isometric), or None; missed it raises, with best_effort too
max_stretch      largest stretch allowed of 99 % of the surface (Measures.stretch_99), or None; in the same way. What is
                 reduced stays E_d; where that alone exceeds the limit, charts climb only as far as it allows
max_boundary_growth  of "needed": how much boundary cuts may add, as a fraction of that of all charts on the surface, or None
seam_cost        of "needed" without max_distortion or max_stretch: the E_d that a cut must save for each unit of boundary
                 growth; default 0.1
effort           of "needed": "fast", "normal" (default) or "best": the more cuts are tried, the fewer seams
trade_off        of "needed": look for all outcomes that are worth a choice between seams and distortion (result.cuts.trade_off)
point            with trade_off: which of them is wanted, from 0; None (default) = what the limits ask for
relax            where less would hold the bound, go on to the least distortion under it; default False. "rectangles" do so
                 anyway, unless until_input
best_effort      where the bound is not reached return the best valid atlas within both limits (bound_met says so), with
                 "needed" seams the least distorted one; default False
density          "equal" (default): one scale for all charts; "keep": each chart its own, as far as bending leaves it that; a
                 warning names those whose texel density changed by more than 10 %; a bound that only charts of more than 1.5
                 times the density of the others would hold is not reached
uv_density       the size of the result as sqrt(UV area / surface area), UV units (of the texture's height) per model unit. A free
                 box may reach beyond [0, 1]^2 then; 0 (default): its longer side is 1. With in_texture charts cover what that
                 size takes, if it is no more than pe_bound, and bend only as far as that asks; else they fill the texture
sigma            of "rectangles": width of the boundary smoothing as a part of a chart's boundary, in (0, 0.1]; default 0.004
candidates       of "rectangles": layouts that are packed and scored, at least 1; default 500
omega            of "rectangles": what added boundary costs against packing efficiency, in [0, 1]; default 0.1
until_input      of "rectangles": stop where the objective is back at the input's (the paper), instead of at its optimum under the
                 bound; default False
reference        the shapes that the objective asks faces to keep: "surface" (default) or "input", its UVs; E_d is told and
                 limited on the surface either way
importance       (F,) numbers > 0: each face's weight in the objective, only ratios count; None (default) = all 1
cut              "split" (default): cuts divide the faces they cross; "edges": only edges of the input become seams
open_closed      charts without a border, or with a handle, may be opened along edges; default False: they are left as they are
stacks           charts of one shape that lie on each other: "keep" (default) them so, or "separate" them
stack_groups     (F,) integers: charts of different ones are no stack, as they show different textures; None = all may be
collapsed        charts whose UVs are a point or a line: "leave" (default) them as they are, or "embed" them
rotate           turns of charts that are moved: "any" (default), "90" or "none"
align_axes       turn moved charts whose longest border runs straight so that it lies on an axis; default False
triangulate      cut faces become triangles throughout; default False
groups           (F,) integers >= 0: the atlas that each face belongs to, each with a box of its own; None = one atlas
group_origins    (G, 2): lower left corner of each group's box; None = (0, 0)
group_aspects    box_aspect of each group that has a number of its own, in [0.01, 100]; box_aspect for the others
group_gaps       the same for gap, which must be given; in its gap_unit
group_densities  the same for uv_density, which must be given; 0 for none, as where charts are locked
group_names      what messages call the groups
keep_shape       (F,) flags: charts with such a face are moved, never bent
locked           (F,) flags: charts with such a face stay where they are, the others go around them in [0, 1]^2
no_seam          (n, 2) pairs of vertices: edges that no cut runs along; "split" may cross some, which a warning counts
prefer_seam      (n, 2) pairs of vertices: edges that cuts along edges, and openings of closed charts, like to follow
triangles        (n, 3) corners: how you divide faces of more than three corners, where you know
stored           "double" (default) or "float32": the format you will store; the certificate holds for it
seed             default 1; the same seed gives the same bits on any number of threads
threads          0 (default) = as many as the machine has
name             names the object in messages
)";

/// Calls back into Python with the GIL held. An exception there stops the run; check() raises it afterwards.
class ProgressCallback {
 public:
  explicit ProgressCallback(py::object function) : function_(std::move(function)) {}

  ProgressFn adapter() {
    return [this](const Progress& progress) -> Answer {
      const py::gil_scoped_acquire gil;
      try {
        if (PyErr_CheckSignals() != 0) throw py::error_already_set();  // Ctrl-C stops a run without a callback too
        if (function_.is_none()) return Answer::GoOn;
        const py::object answer = function_(progress);
        if (py::isinstance<py::str>(answer) && answer.cast<std::string>() == "finish") return Answer::Finish;
        return !answer.is(py::bool_(false));
      } catch (...) {
        raised_ = std::current_exception();
        return Answer::Cancel;
      }
    };
  }

  void check() const {
    if (raised_) std::rethrow_exception(raised_);
  }

 private:
  py::object function_;
  std::exception_ptr raised_;
};

RefineResult call_refine(const py::object& positions, const py::object& face_offsets, const py::object& corner_vertices,
                         const py::object& corner_uvs, const py::kwargs& kwargs) {
  const Keywords keywords = read_keywords(kwargs, "refine", kRefineKeywords + " progress");
  Atlas atlas = to_atlas({positions, face_offsets, corner_vertices, corner_uvs}, keywords.name);
  atlas.triangles = keywords.triangles;
  ProgressCallback callback(keywords.progress);
  std::optional<RefineResult> result;
  try {
    const py::gil_scoped_release release;
    result = refine(atlas, keywords.options, callback.adapter());
  } catch (const RefineError&) {
    callback.check();
    throw;
  }
  callback.check();
  return std::move(*result);
}

std::unique_ptr<Job> start(const py::object& positions, const py::object& face_offsets, const py::object& corner_vertices,
                           const py::object& corner_uvs, const py::kwargs& kwargs) {
  const Keywords keywords = read_keywords(kwargs, "start", kRefineKeywords);
  Atlas atlas = to_atlas({positions, face_offsets, corner_vertices, corner_uvs}, keywords.name);
  atlas.triangles = keywords.triangles;
  return std::make_unique<Job>(std::move(atlas), keywords.options);
}

Measures call_measure(const py::object& positions, const py::object& face_offsets, const py::object& corner_vertices,
                      const py::object& corner_uvs, const py::kwargs& kwargs) {
  const Keywords keywords = read_keywords(kwargs, "measure", "box_aspect in_texture triangles name");
  Atlas atlas = to_atlas({positions, face_offsets, corner_vertices, corner_uvs}, keywords.name);
  atlas.triangles = keywords.triangles;
  const py::gil_scoped_release release;
  return measure(atlas, keywords.options.box_aspect, keywords.options.in_texture);
}

Validity call_validate(const py::object& positions, const py::object& face_offsets, const py::object& corner_vertices,
                       const py::object& corner_uvs, const py::kwargs& kwargs) {
  const Keywords keywords = read_keywords(kwargs, "validate", "name");
  const Atlas atlas = to_atlas({positions, face_offsets, corner_vertices, corner_uvs}, keywords.name);
  const py::gil_scoped_release release;
  return validate(atlas);
}

py::array_t<std::int32_t> call_charts_of_faces(const py::object& positions, const py::object& face_offsets,
                                               const py::object& corner_vertices, const py::object& corner_uvs,
                                               const py::kwargs& kwargs) {
  const Keywords keywords = read_keywords(kwargs, "charts_of_faces", "groups name");
  const Atlas atlas = to_atlas({positions, face_offsets, corner_vertices, corner_uvs}, keywords.name);
  std::vector<int> charts;
  {
    const py::gil_scoped_release release;
    charts = charts_of_faces(atlas, keywords.options.groups);
  }
  return to_array(charts);
}

py::dict call_find_problems(const py::object& positions, const py::object& face_offsets, const py::object& corner_vertices,
                            const py::object& corner_uvs, const py::kwargs& kwargs) {
  const Keywords keywords = read_keywords(kwargs, "find_problems", "triangles name");
  Atlas atlas = to_atlas({positions, face_offsets, corner_vertices, corner_uvs}, keywords.name);
  atlas.triangles = keywords.triangles;
  Problems problems;
  {
    const py::gil_scoped_release release;
    problems = find_problems(atlas);
  }
  py::dict out;
  out["unwrapped"] = to_array(problems.unwrapped);
  out["zero_area"] = to_array(problems.zero_area);
  out["flipped"] = to_array(problems.flipped);
  out["mirrored"] = to_array(problems.mirrored);
  out["overlapping"] = to_array(problems.overlapping);
  return out;
}

py::tuple call_group_by_tile(const py::object& positions, const py::object& face_offsets, const py::object& corner_vertices,
                             const py::object& corner_uvs, const py::kwargs& kwargs) {
  const Keywords keywords = read_keywords(kwargs, "group_by_tile", "name");
  const Atlas atlas = to_atlas({positions, face_offsets, corner_vertices, corner_uvs}, keywords.name);
  TileGroups tiles;
  {
    const py::gil_scoped_release release;
    tiles = group_by_tile(atlas);
  }
  return py::make_tuple(to_array(tiles.groups), to_array(tiles.origins), py::cast(tiles.names));
}

template <typename Function>
void define(py::module_& module, const char* name, Function function, const std::string& doc) {
  module.def(name, function, py::arg("positions"), py::arg("face_offsets"), py::arg("corner_vertices"), py::arg("corner_uvs"),
             doc.c_str());
}

/// NumPy 2 lays its types out in another way: pybind11 before 2.12 would read and write arrays wrongly, without a word.
void check_numpy() {
#if PYBIND11_VERSION_HEX < 0x020C0000
  const auto version = py::module_::import("numpy").attr("__version__").cast<std::string>();
  if (version[0] != '1' || version[1] != '.') {
    throw py::import_error("built with a pybind11 that knows NumPy 1 alone, and this is NumPy " + version);
  }
#endif
}

}  // namespace

PYBIND11_MODULE(_atlas_refine, module) {
  check_numpy();
  py::options options;
  options.disable_function_signatures();  // the type stub has the readable ones
  module.doc() = "Atlas Refine: brings a UV atlas to a packing efficiency bound.";
  module.attr("__version__") = version();
  bind_error(module);
  bind_results(module);
  bind_job(module);

  const std::string arrays = kArraysDoc;
  const std::string raises = "\nRaises AtlasRefineError (code, stage, chart, face).";
  define(
      module, "refine", &call_refine,
      "Brings an atlas to a packing efficiency bound and returns a RefineResult; the arrays are left alone." + arrays +
          kRefineOptionsDoc +
          "progress         called with a Progress several times a second; returning False cancels, what it raises comes out;\n"
          "                 \"finish\" ends with the best valid atlas so far, or the input where that is no better\n" +
          raises);
  define(module, "start", &start, "refine() in the background: returns a Job at once." + arrays + kRefineOptionsDoc + raises);
  define(module, "measure", &call_measure,
         "Measures an atlas as it is.\n\nKeywords box_aspect (width / height of the texture that [0, 1]^2 stands for, 0 = free), "
         "in_texture (pe_fixed_aspect is what charts cover of it), triangles (as of refine()) and name." +
             arrays + raises);
  define(module, "validate", &call_validate,
         "Exact test on the values as given: every UV triangle positive, no boundaries crossing or touching.\n\nKeyword name." +
             arrays + raises);
  define(module, "charts_of_faces", &call_charts_of_faces,
         "The chart that each face belongs to, an index into RefineResult.charts of a refine() of the same arrays and groups.\n\n"
         "Keywords groups (as of refine()) and name." +
             arrays + raises);
  define(
      module, "find_problems", &call_find_problems,
      "Faces that somebody should look at, as a dict of ascending arrays: \"unwrapped\" (no UVs, or a chart that is a point or a "
      "line), \"zero_area\", \"flipped\" (against their chart), \"mirrored\" (of charts turned over as a whole) and "
      "\"overlapping\" (with another face; exact).\n\nKeywords triangles (as of refine()) and name." +
          arrays + raises);
  define(
      module, "group_by_tile", &call_group_by_tile,
      "UDIM tiles as (groups, group_origins, group_names) of refine(); a chart is of the tile in which the centre of its UV box "
      "lies.\n\nKeyword name." +
          arrays + raises);
}

}  // namespace atlas_refine::python
