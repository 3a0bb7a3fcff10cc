// Chart by chart.
#include "coarsen/coarse_atlas.h"

#include <cmath>

#include "coarsen/prolong.h"
#include "support/parallel.h"
#include "support/profile.h"
#include "support/thread_pool.h"

namespace atlas_refine {
namespace {

constexpr int kSmall = 1500;       // vertices of an atlas that is squeezed as it is
constexpr double kInside = 1000;   // triangles that all charts together would have far from their boundaries
constexpr double kMostKept = 0.6;  // of all vertices of charts that bend: else there is little to gain

std::size_t element_count(const Chart& chart) { return chart.triangles.size() + chart.guards.size(); }

ChartObjective slice(const Objective& objective, std::size_t first, std::size_t count) {
  const auto begin = static_cast<std::ptrdiff_t>(first), end = static_cast<std::ptrdiff_t>(first + count);
  return {{objective.inverse_edges.begin() + begin, objective.inverse_edges.begin() + end},
          {objective.weight.begin() + begin, objective.weight.begin() + end}};
}

int bending_vertices(const std::vector<Chart>& charts, const Freedoms& freedom) {
  int count = 0;
  for (std::size_t c = 0; c < charts.size(); ++c) count += bends(freedom, c) ? charts[c].vertex_count() : 0;
  return count;
}

double surface_of_bending(const std::vector<Chart>& charts, const Freedoms& freedom) {
  double area = 0;
  for (std::size_t c = 0; c < charts.size(); ++c) area += bends(freedom, c) ? charts[c].surface.area() : 0;
  return area;
}

}  // namespace

double spacing_inside(double area) {
  return std::sqrt(4 / std::sqrt(3.0) * area / kInside);  // edges of equilateral triangles
}

std::optional<CoarseAtlas> coarsen(const std::vector<Chart>& charts, const Objective& objective, const Freedoms& freedom,
                                   const Sample* of_only_chart) {
  const PhaseScope scope(Phase::Coarsen);
  const int vertices = bending_vertices(charts, freedom);
  if (vertices < kSmall) return std::nullopt;
  const double spacing = spacing_inside(surface_of_bending(charts, freedom));
  const int count = static_cast<int>(charts.size());
  CoarseAtlas out{.charts = std::vector<std::optional<CoarseChart>>(count), .objective = {.unit = objective.unit}};
  parallel_ranges(count, present_threads(), 1, [&](int begin, int end) {
    for (int c = begin; c < end; ++c) {
      if (!bends(freedom, c)) continue;
      out.charts[c] = coarsen(charts[c], of_only_chart ? *of_only_chart : sample_of_coarse(charts[c], spacing));
    }
  });
  int kept = vertices;
  for (int c = 0; c < count; ++c) {
    if (out.charts[c]) kept -= charts[c].vertex_count() - out.charts[c]->mesh.vertex_count();
  }
  if (kept > kMostKept * vertices) return std::nullopt;
  std::size_t first = 0;
  for (int c = 0; c < count; first += element_count(charts[c]), ++c) {
    const ChartObjective fine = slice(objective, first, element_count(charts[c]));
    const ChartObjective own = out.charts[c] ? coarse_objective(charts[c], *out.charts[c], fine) : fine;
    out.objective.inverse_edges.insert(out.objective.inverse_edges.end(), own.inverse_edges.begin(), own.inverse_edges.end());
    out.objective.weight.insert(out.objective.weight.end(), own.weight.begin(), own.weight.end());
  }
  return out;
}

PlacedCharts restricted(const CoarseAtlas& coarse, const PlacedCharts& fine) {
  PlacedCharts out{.charts = {}, .frame = fine.frame};
  for (std::size_t c = 0; c < fine.charts.size(); ++c) {
    if (!coarse.charts[c]) {
      out.charts.push_back(fine.charts[c]);
      continue;
    }
    Chart& chart = out.charts.emplace_back(coarse.charts[c]->mesh);
    for (int v = 0; v < chart.vertex_count(); ++v) chart.uvs[v] = fine.charts[c].uvs[coarse.charts[c]->kept[v]];
  }
  return out;
}

std::optional<std::vector<std::vector<Vec2>>> prolonged(const CoarseAtlas& coarse, const std::vector<Chart>& fine,
                                                        const Objective& objective,
                                                        const std::vector<std::vector<Vec2>>& coarse_uvs) {
  const PhaseScope scope(Phase::Coarsen);
  std::vector<std::vector<Vec2>> out;
  std::size_t first = 0;
  for (std::size_t c = 0; c < fine.size(); first += element_count(fine[c]), ++c) {
    if (!coarse.charts[c]) {
      out.push_back(coarse_uvs[c]);
      continue;
    }
    auto uvs =
        prolong(fine[c], *coarse.charts[c], coarse_uvs[c], slice(objective, first, element_count(fine[c])), objective.unit);
    if (!uvs) return std::nullopt;
    out.push_back(std::move(*uvs));
  }
  return out;
}

}  // namespace atlas_refine
