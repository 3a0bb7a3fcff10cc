// The public measure() and validate(): the atlas is split into charts, the charts are measured where they lie.
#include "report/measure_atlas.h"

#include "atlas_refine/error.h"
#include "measure/certificate.h"
#include "measure/metrics.h"
#include "report/options.h"

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

Measures measure(const Atlas& atlas, double box_aspect) {
  check_aspect(box_aspect);
  return read_atlas(atlas, box_aspect).measures;
}

InputAtlas read_atlas(const Atlas& atlas, double box_aspect) {
  InputAtlas input{atlas, split_charts(atlas), {}};
  stretch_to_texture(input.set.charts, box_aspect);
  input.measures = measure_split(atlas, input.set, box_aspect);
  return input;
}

void stretch_to_texture(std::vector<Chart>& charts, double box_aspect) {
  if (box_aspect == 0 || box_aspect == 1) return;
  for (Chart& chart : charts) {
    for (Vec2& uv : chart.uvs) uv.x() *= box_aspect;
  }
}

Measures measure_split(const Atlas& atlas, const ChartSet& set, double box_aspect) {
  Measures measures = measure_charts(charts_as_placed(set), box_aspect);
  if (box_aspect > 0) measures.box_width /= box_aspect;
  measures.unit_square_share = measures.pe * measures.box_width * measures.box_height;
  measures.seam_edges = set.seam_edges;
  const double diagonal = bounding_box_diagonal(atlas);
  measures.boundary_length = diagonal > 0 ? set.seam_length / diagonal : 0;
  return measures;
}

Validity validate(const Atlas& atlas) { return validate_split(split_charts(atlas)); }

Validity validate_split(const ChartSet& set) {
  Validity validity = certify_charts(charts_as_placed(set));
  // Faces count here, and an n-gon counts where its outline crosses itself though some triangulation of it were positive.
  validity.flipped_faces = static_cast<int>(set.defects.size());
  for (std::size_t k = set.mirrored.size(); k-- > 0;) {
    if (!set.mirrored[k]) continue;
    ++validity.mirrored_charts;
    validity.problem = "chart " + std::to_string(k) + " is mirrored";
    validity.chart = static_cast<int>(k);
    validity.face = -1;
  }
  if (!set.defects.empty()) {
    validity.problem = describe(set.defects.front());
    validity.chart = set.defects.front().chart;
    validity.face = set.defects.front().face;
  }
  return validity;
}

}  // namespace atlas_refine
