// The public measure() and validate(): the atlas is split into charts, the charts are measured where they lie.
#include "report/measure_atlas.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "input/take_part.h"
#include "measure/certificate.h"
#include "measure/metrics.h"
#include "report/options.h"
#include "report/texture.h"
#include "support/parallel.h"

namespace atlas_refine {

namespace {

double bounding_box_diagonal(const Atlas& atlas) {
  Vec3 low = atlas.positions[atlas.corner_vertices[0]], high = low;
  for (int v : atlas.corner_vertices) {
    low = low.cwiseMin(atlas.positions[v]);
    high = high.cwiseMax(atlas.positions[v]);
  }
  return (high - low).norm();
}

}  // namespace

Measures measure(const Atlas& atlas, double box_aspect, bool in_texture) {
  check_aspect(box_aspect);
  if (in_texture && box_aspect == 0) box_aspect = 1;
  const InputAtlas whole = read_atlas(atlas, {.box_aspect = box_aspect});
  const Participants all = take_part(whole.set, {}, {});
  Measures measures;
  if (!all.parts.empty()) {
    InputAtlas part = part_of(whole, all.parts.front().charts, box_aspect);
    put_in_texture(part, {.box_aspect = box_aspect, .in_texture = in_texture});
    measures = part.measures;
  }
  measure_seams(atlas, seams_of(whole.set), measures);
  return measures;
}

InputAtlas read_atlas(const Atlas& atlas, const RefineOptions& options) {
  InputAtlas input{atlas, split_charts(atlas, Joining::AsMeant, options.groups, resolve_threads(options.threads))};
  for (Chart& chart : input.set.charts)
    stretch_to_texture(chart, options_of_group(options, group_of(chart, options.groups)).box_aspect);
  return input;
}

InputAtlas part_of(const InputAtlas& whole, const std::vector<int>& charts, double box_aspect) {
  InputAtlas part{whole.atlas, select_charts(whole.set, charts)};
  part.measures = measure_split(part.set, box_aspect);
  return part;
}

Measures of_nothing() {
  Measures out;
  for (auto none : {&Measures::distortion, &Measures::distortion_to_input, &Measures::stretch_99, &Measures::stretch_max})
    out.*none = std::numeric_limits<double>::quiet_NaN();
  for (auto gap : {&Measures::gap_between, &Measures::gap_within}) out.*gap = INFINITY;
  return out;
}

Measures combined(const std::vector<Measures>& parts, const std::vector<double>& areas) {
  if (parts.empty()) return of_nothing();
  Measures out = parts.front();
  double total = areas.front();
  for (std::size_t k = 1; k < parts.size(); ++k) {
    const Measures& m = parts[k];
    for (auto least : {&Measures::pe, &Measures::pe_fixed_aspect, &Measures::box_width, &Measures::box_height,
                       &Measures::unit_square_share, &Measures::gap_between, &Measures::gap_within})
      out.*least = std::min(out.*least, m.*least);
    out.chart_count += m.chart_count;
    out.small_charts += m.small_charts;
    out.smallest_chart = std::min(out.smallest_chart * total, m.smallest_chart * areas[k]) / (total + areas[k]);
    const double share = areas[k] / (total + areas[k]);
    for (auto mean : {&Measures::distortion, &Measures::distortion_to_input, &Measures::stretch_99})
      out.*mean += share * (m.*mean - out.*mean);
    out.stretch_max = std::max(out.stretch_max, m.stretch_max);
    total += areas[k];
  }
  return out;
}

void measure_seams(const Atlas& atlas, const SeamCount& seams, Measures& measures) {
  measures.seam_edges = seams.edges;
  const double diagonal = bounding_box_diagonal(atlas);
  measures.boundary_length = diagonal > 0 ? seams.length / diagonal : 0;
}

void stretch_to_texture(Chart& chart, double box_aspect) {
  if (box_aspect == 0 || box_aspect == 1) return;
  for (Vec2& uv : chart.uvs) uv.x() *= box_aspect;
}

void stretch_to_texture(std::vector<Chart>& charts, double box_aspect) {
  for (Chart& chart : charts) stretch_to_texture(chart, box_aspect);
}

Measures measure_split(const ChartSet& set, double box_aspect) {
  Measures measures = measure_charts(charts_as_placed(set), box_aspect);
  if (box_aspect > 0) measures.box_width /= box_aspect;
  measures.unit_square_share = measures.pe * measures.box_width * measures.box_height;
  return measures;
}

Validity validate(const Atlas& atlas) { return validate_split(split_charts(atlas)); }

Validity validate_split(const ChartSet& set, const Freedoms& freedom) {
  Validity validity = certify_charts(charts_as_placed(set), set.points, freedom);
  // Faces count here, and an n-gon counts where its outline crosses itself though some triangulation of it were positive.
  validity.flipped_faces = static_cast<int>(set.defects.size());
  validity.triangulations = count_readings(set.readings);
  for (std::size_t k = set.mirrored.size(); k-- > 0;) {
    if (!set.mirrored[k]) continue;
    ++validity.mirrored_charts;
    validity.chart = set.charts[k].number;
    validity.problem = "chart " + std::to_string(validity.chart) + " is mirrored";
    validity.face = -1;
  }
  if (!set.defects.empty()) {
    validity.chart = set.charts[set.defects.front().chart].number;
    validity.problem = describe(set.defects.front(), validity.chart);
    validity.face = set.defects.front().face;
  }
  return validity;
}

Triangulations count_readings(const std::vector<FaceReading>& readings) {
  Triangulations out;
  for (const FaceReading& reading : readings) {
    if (reading.chart < 0) continue;
    out.fan_flipped += !reading.fan;
    out.ears_flipped += !reading.ears;
    out.not_convex += !reading.diagonals;
  }
  return out;
}

}  // namespace atlas_refine
