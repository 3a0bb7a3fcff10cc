// A row of charts, no box.
#include "reduce/relax_apart.h"

#include "measure/distortion.h"
#include "reduce/reduce.h"

namespace atlas_refine {
namespace {

constexpr double kApart = 0.3;         // of a chart's diagonal
constexpr double kLeastChange = 1e-2;  // ReduceProblem::least_change: outlines hardly change any more
constexpr double kNegligible = 1e-5;   // ReduceProblem::negligible

void lay_in_a_row(std::vector<Chart>& charts) {
  double end = 0;
  for (Chart& chart : charts) {
    const Box box = uv_box({chart});
    for (Vec2& uv : chart.uvs) uv += Vec2(end, 0) - box.min;
    end += box.size().x() + kApart * box.diagonal();
  }
}

}  // namespace

std::vector<Chart> relaxed_apart(std::vector<Chart> charts, const Objective& objective, const Gap& gap, const Freedoms& freedom,
                                 Monitor& monitor) {
  lay_in_a_row(charts);
  const ReduceProblem problem{.charts = charts,
                              .objective = &objective,
                              .gap = gap,
                              .least_change = kLeastChange,
                              .negligible = kNegligible,
                              .freedom = freedom};
  ReduceResult result = reduce_distortion(problem, [&](const ReduceProgress&) { return !monitor.finishing(); });
  for (std::size_t c = 0; c < charts.size(); ++c) charts[c].uvs = std::move(result.uvs[c]);
  return charts;
}

}  // namespace atlas_refine
