// The result of one call, and the certificate without which none leaves the library.
#include "report/outcome.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>

#include "atlas_refine/error.h"
#include "input/check_atlas.h"
#include "measure/distortion.h"
#include "measure/metrics.h"
#include "measure/snapshot.h"
#include "report/cut_faces.h"
#include "report/measure_atlas.h"

namespace atlas_refine {
namespace {

std::string number(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

/// The value that is left after storing it in single precision. GCC 12 drops the plain round trip where it vectorises two of
/// them.
double rounded_to_single(double value) {
  volatile float stored = static_cast<float>(value);
  return stored;
}

/// "chart 3", "charts 3, 5", or how many they are.
std::string charts_named(const std::vector<int>& charts) {
  constexpr std::size_t kMostNamed = 6;
  if (charts.size() > kMostNamed) return std::to_string(charts.size()) + " charts";
  std::string text = charts.size() == 1 ? "chart" : "charts";
  for (std::size_t k = 0; k < charts.size(); ++k) text += (k > 0 ? ", " : " ") + std::to_string(charts[k]);
  return text;
}

std::vector<int> identity(std::size_t count) {
  std::vector<int> out(count);
  std::iota(out.begin(), out.end(), 0);
  return out;
}

}  // namespace

const char* to_string(Intervention intervention) {
  switch (intervention) {
    case Intervention::Unchanged:
      return "unchanged";
    case Intervention::Moved:
      return "moved";
    case Intervention::Squeezed:
      return "squeezed";
    case Intervention::Cut:
      return "cut";
  }
  return "unknown";
}

Outcome::Outcome(const Atlas& atlas, const RefineOptions& options, Monitor& monitor, DebugSink* debug)
    : atlas_(atlas), options_(options), monitor_(monitor), debug_(debug) {}

void Outcome::begin_stage(const std::string& stage, double from, double to) {
  end_stage();
  monitor_.begin_stage(stage, from, to);
  stage_ = stage;
  stage_start_ = std::chrono::steady_clock::now();
}

void Outcome::end_stage() {
  if (stage_.empty()) return;
  result_.timings.push_back({stage_, std::chrono::duration<double>(std::chrono::steady_clock::now() - stage_start_).count()});
  stage_.clear();
}

void Outcome::measure_input(const ChartSet& set) {
  corners_ = set.corners;
  input_charts_ = set.charts;
  result_.before = measure_split(atlas_, set, options_.box_aspect);
  for (std::size_t c = 0; c < input_charts_.size(); ++c) {
    ChartReport chart;
    std::vector<int> faces = input_charts_[c].triangle_faces;
    std::sort(faces.begin(), faces.end());
    chart.faces = static_cast<int>(std::unique(faces.begin(), faces.end()) - faces.begin());
    chart.mirrored = set.mirrored[c];
    chart.distortion_before = dirichlet_sums(input_charts_[c]).best_energy();
    result_.charts.push_back(chart);
  }
  const auto mirrored = std::count(set.mirrored.begin(), set.mirrored.end(), true);
  if (mirrored == 1) {
    const auto first = std::find(set.mirrored.begin(), set.mirrored.end(), true) - set.mirrored.begin();
    result_.repairs.push_back("chart " + std::to_string(first) + ": mirrored, turned over");
  } else if (mirrored > 1) {
    result_.repairs.push_back(std::to_string(mirrored) + " charts: mirrored, turned over");
  }
  show("input", charts_as_placed(set));
}

void Outcome::re_embedded(int chart) {
  result_.charts[chart].re_embedded = true;
  result_.repairs.push_back("chart " + std::to_string(chart) + ": overlapped or touched itself, embedded anew");
}

void Outcome::squeezed(const Squeezed& squeezed) {
  result_.price = squeezed.outcome.price;
  result_.iterations += squeezed.iterations;
  warn_of_gap(squeezed.gap, result_.warnings);
}

void Outcome::aligned(const std::vector<AxisAlignedChart>& aligned) {
  RectangleReport& report = cut_.report;
  std::vector<int> opened, saved;
  for (int c = 0; c < static_cast<int>(aligned.size()); ++c) {
    if (aligned[c].holes_cut > 0) opened.push_back(c);
    if (aligned[c].way == AxisAlignedChart::Way::Rectangle) saved.push_back(c);
    report.boxed_charts += aligned[c].way == AxisAlignedChart::Way::AsItIs;
    report.holes_cut += aligned[c].holes_cut;
  }
  report.tutte_charts = static_cast<int>(saved.size());
  if (!opened.empty())
    cut_.repairs.push_back(charts_named(opened) + ": " + std::to_string(report.holes_cut) +
                           (report.holes_cut == 1 ? " hole" : " holes") + " cut open along shortest paths");
  if (!saved.empty())
    cut_.warnings.push_back(charts_named(saved) + ": could not be deformed to the axes; embedded onto a rectangle");
}

void Outcome::laid_out(const Layout& layout) {
  RectangleReport& report = cut_.report;
  for (const auto& trails : layout.trails) report.trails += static_cast<int>(trails.size());
  report.extra_corners = layout.extra_corners;
  report.packed_pe = layout.pe;
  warn_of_gap(layout.gap, cut_.warnings);
}

void Outcome::warn_of_gap(const Gap& gap, std::vector<std::string>& warnings) const {
  if (options_.gap || gap.value >= Gap{}.value) return;
  warnings.push_back("the gap was reduced from " + number("%g", Gap{}.value) + " to " + number("%g", gap.value) +
                     " of the box diagonal: the bound does not leave more");
}

void Outcome::show(const std::string& stage, const std::vector<Chart>& charts) {
  if (!debug_) return;
  const Measures measures = measure_charts(charts, options_.box_aspect);
  const std::string caption =
      "PE " + number("%.1f %%", 100 * measures.pe_fixed_aspect) + ", E_d " + number("%.4f", measures.distortion);
  debug_->receive(make_snapshot(stage, caption, charts, box_of_aspect(uv_box(charts), options_.box_aspect)));
}

RefineResult Outcome::unchanged(const Gap& gap) {
  end_stage();
  result_.intervention = Intervention::Unchanged;
  result_.corner_uvs = atlas_.corner_uvs;
  result_.bound_met = true;
  result_.after = result_.before;
  // An automatic gap asks nothing of an atlas that is left as it is.
  result_.gap = gap;
  if (!options_.gap) result_.gap.value = std::min(gap.value, result_.before.gap_between);
  report_charts(input_charts_, identity(input_charts_.size()));
  return result_;
}

RefineResult Outcome::certified(Intervention intervention, const std::vector<Chart>& charts, const Gap& gap) {
  begin_stage("certify", 0.95, 1);
  Output output{atlas_, corners_, input_charts_, input_charts_, identity(charts.size())};
  for (std::size_t c = 0; c < charts.size(); ++c) output.charts[c].uvs = charts[c].uvs;
  return certify(intervention, std::move(output), gap);
}

RefineResult Outcome::certified_cut(const ChartSet& set, const CutCharts& cut, const Gap& gap) {
  begin_stage("certify", 0.95, 1);
  const std::vector<Chart> pieces = meshes_of(cut);
  CutFaces faces = cut_faces(atlas_, set, cut);
  Output output{atlas_, std::move(faces.corners), pieces, pieces, {}};
  output.atlas.positions = std::move(faces.positions);
  output.atlas.face_offsets = faces.mesh.face_offsets;
  output.atlas.corner_vertices = faces.mesh.corner_vertices;
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    const CutPiece& piece = cut.pieces[p];
    output.input_charts.push_back(piece.chart);
    for (int v = 0; v < piece.mesh.vertex_count(); ++v)
      output.input[p].uvs[v] = value_at(piece.supports[v], input_charts_[piece.chart].uvs);
    for (std::size_t t = 0; t < piece.sources.size(); ++t) {
      const Triangle& v = piece.mesh.triangles[t];
      output.charts[p].rest[t] = rest_of_part(input_charts_[piece.chart], piece.sources[t],
                                              {piece.supports[v[0]], piece.supports[v[1]], piece.supports[v[2]]});
    }
  }
  result_.cut = std::move(faces.mesh);
  result_.rectangles = cut_.report;
  result_.repairs.insert(result_.repairs.end(), cut_.repairs.begin(), cut_.repairs.end());
  result_.warnings.insert(result_.warnings.end(), cut_.warnings.begin(), cut_.warnings.end());
  return certify(Intervention::Cut, std::move(output), gap);
}

RefineResult Outcome::certify(Intervention intervention, Output output, const Gap& gap) {
  result_.intervention = intervention;
  result_.gap = gap;
  store(output);
  const ChartSet set = split_charts(output.atlas);
  result_.after = measure_split(output.atlas, set, options_.box_aspect);
  require_certificate(set, static_cast<int>(output.charts.size()), gap);
  require_bound();
  // The same triangles in the same order as the input's: only then can E_2 be told.
  result_.after.distortion_to_input = dirichlet_sums_between(output.input, output.charts).best_energy();
  report_charts(output.charts, output.input_charts);
  show(to_string(intervention), output.charts);
  result_.corner_uvs = std::move(output.atlas.corner_uvs);
  end_stage();
  return result_;
}

/// Scales the charts into the unit square and rounds them as they will be stored.
void Outcome::store(Output& output) const {
  const Box box = box_of_aspect(uv_box(output.charts), options_.box_aspect);
  const double scale = 1 / box.size().maxCoeff();
  for (Chart& chart : output.charts) {
    for (Vec2& uv : chart.uvs) {
      uv = scale * (uv - box.min);
      if (options_.stored == Stored::Float32) uv = Vec2(rounded_to_single(uv.x()), rounded_to_single(uv.y()));
    }
  }
  output.atlas.corner_uvs.clear();
  for (const CornerRef& corner : output.corners)
    output.atlas.corner_uvs.push_back(output.charts[corner.chart].uvs[corner.vertex]);
}

void Outcome::require_certificate(const ChartSet& output, int chart_count, const Gap& gap) {
  const auto refuse = [&](const std::string& why, int chart, int face) {
    throw RefineError(ErrorCode::NotCertified, "certify", message_prefix(atlas_) + "the result was withheld: " + why, chart,
                      face);
  };
  const Validity validity = validate_split(output);
  if (!validity.valid()) refuse(validity.problem, validity.chart, validity.face);
  const bool seams_kept = result_.cut || result_.after.seam_edges == result_.before.seam_edges;
  if (!seams_kept || result_.after.chart_count != chart_count) refuse("its seams are not those that were meant", -1, -1);
  const Vec2 box(result_.after.box_width, result_.after.box_height);
  const Vec2 whole = box_of_aspect({Vec2::Zero(), box}, options_.box_aspect).size();
  if (result_.after.gap_between * box.norm() < gap.length(whole)) {
    refuse("two charts are " + number("%.6g", result_.after.gap_between) + " of the diagonal apart, nearer than the gap of " +
               number("%g", gap.value),
           -1, -1);
  }
}

void Outcome::require_bound() {
  const bool allowed = !options_.max_distortion || options_.density == Density::Keep ||
                       result_.after.distortion <= *options_.max_distortion * (1 + 1e-9);
  result_.bound_met = result_.after.pe_fixed_aspect >= options_.pe_bound && allowed;
  if (result_.bound_met || options_.best_effort) return;
  std::string message = message_prefix(atlas_) + "the bound " + number("%g", options_.pe_bound) + " was not reached";
  if (options_.max_distortion) message += " within a distortion of " + number("%g", *options_.max_distortion);
  message += "; the best packing efficiency found is " + number("%.4f", result_.after.pe_fixed_aspect) + " at E_d " +
             number("%.4f", result_.after.distortion);
  throw RefineError(ErrorCode::BoundNotReached, "squeeze", message);
}

void Outcome::report_charts(const std::vector<Chart>& charts, const std::vector<int>& input_charts) {
  const double scale = dirichlet_sums(charts).best_scale();
  std::vector<DirichletSums> sums(result_.charts.size());
  for (std::size_t k = 0; k < charts.size(); ++k) {
    const std::vector<double> stretch = triangle_stretch(charts[k], scale);
    ChartReport& report = result_.charts[input_charts[k]];
    report.stretch_max = std::max(report.stretch_max, *std::max_element(stretch.begin(), stretch.end()));
    sums[input_charts[k]] += dirichlet_sums(charts[k]);
  }
  for (std::size_t c = 0; c < sums.size(); ++c) result_.charts[c].distortion_after = sums[c].best_energy();
}

}  // namespace atlas_refine
