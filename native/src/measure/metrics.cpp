// The figures of measures.h, from charts (section 4, "Quality metrics").
#include "measure/metrics.h"

#include <algorithm>

#include "measure/certificate.h"
#include "measure/distortion.h"

namespace atlas_refine {

namespace {

constexpr double kSmallChart = 0.03;  // N3 counts charts below this share of the surface

void measure_chart_sizes(const std::vector<Chart>& charts, Measures& measures) {
  std::vector<double> areas;
  double total = 0;
  for (const Chart& chart : charts) {
    areas.push_back(chart.surface.area());
    total += areas.back();
  }
  measures.chart_count = static_cast<int>(charts.size());
  measures.smallest_chart = *std::min_element(areas.begin(), areas.end()) / total;
  measures.small_charts =
      static_cast<int>(std::count_if(areas.begin(), areas.end(), [&](double area) { return area < kSmallChart * total; }));
}

}  // namespace

Measures measure_charts(const std::vector<Chart>& charts, double box_aspect) {
  Measures measures;
  const Box box = uv_box(charts);
  const double area = uv_area(charts);
  const auto share_of = [&](const Box& whole) { return whole.area() > 0 ? area / whole.area() : 0; };
  measures.pe = share_of(box);
  measures.pe_fixed_aspect = share_of(box_of_aspect(box, box_aspect));
  measures.box_width = box.size().x();
  measures.box_height = box.size().y();
  measure_chart_sizes(charts, measures);
  const DirichletSums sums = dirichlet_sums(charts);
  measures.distortion = sums.best_energy();
  measures.distortion_to_input = 1;
  measures.stretch_99 = stretch_99(charts, sums.best_scale());
  measures.stretch_max = 0;
  for (const Chart& chart : charts) {
    for (const double stretch : triangle_stretch(chart, sums.best_scale()))
      measures.stretch_max = std::max(measures.stretch_max, stretch);
  }
  const double diagonal = box.diagonal() > 0 ? box.diagonal() : 1;
  measures.gap_between = gap_between_charts(charts) / diagonal;
  measures.gap_within = gap_within(charts, sums.best_scale(), kFarArc);
  return measures;
}

}  // namespace atlas_refine
