// Tutte's embedding, its rounding mended, and from there downhill; of many triangles on fewer first.
#include "repair/embed.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "coarsen/coarse_atlas.h"
#include "coarsen/decimate.h"
#include "coarsen/prolong.h"
#include "geometry/guards.h"
#include "geometry/rest_triangle.h"
#include "geometry/tutte.h"
#include "measure/bad_triangles.h"
#include "measure/certificate.h"
#include "measure/distortion.h"
#include "reduce/reduce.h"
#include "repair/convex_again.h"
#include "repair/untangle.h"
#include "solve/symmetric_dirichlet.h"

namespace atlas_refine {
namespace {

// The disk that the embedding starts from has a smaller box than what comes out: ask for more than the default gap.
constexpr double kGapForLargerBox = 1.5;
constexpr double kGentle = 10;         // E_d of a start that needs no evening out
constexpr double kCollapsed = 100;     // E_d above which an embedding is no use
constexpr double kLeastWeight = 1e-3;  // of a triangle, as a fraction of the mean one

// The way down ends where E_d - 1 changes by less than this part of it: a squeeze goes on from there,
constexpr double kSettled = 2e-3;
constexpr double kRoughlySettled = 0.05;  // and a start need only have its parts at their sizes.

/// Fewer are soon down by themselves.
bool has_many(const Chart& chart) {
  constexpr std::size_t kMany = 3000;
  return chart.triangles.size() >= kMany;
}

/// The triangles on the surface's shapes, the outer boundary where it is, every other loop filled.
/// With the outer boundary convex, all of them positive means an embedding, with polygons convex where they have guards.
Tangle filled_disk(const Chart& chart, const Filling& filling, std::vector<Vec2>& uvs) {
  Tangle out;
  const double least = kLeastWeight * chart.surface.area() / static_cast<double>(chart.triangles.size());
  const auto fill = [&](const Triangle& triangle) {
    out.triangles.push_back(triangle);
    out.inverse_edges.push_back(rest_equilateral(least).inverse_edges);
    out.weights.push_back(least);
  };
  for_each_element(chart, [&](const Triangle& triangle, const RestTriangle& rest, double share, int) {
    out.triangles.push_back(triangle);
    out.inverse_edges.push_back(rest.inverse_edges);
    out.weights.push_back(std::max(least, share * rest.area));
  });
  for (const Triangle& triangle : filling.triangles) fill(triangle);
  for (const std::size_t l : filling.fans) {
    const std::vector<int>& loop = chart.boundary_loops[l];
    const int hidden = static_cast<int>(uvs.size());
    Vec2 middle = Vec2::Zero();
    for (const int v : loop) middle += uvs[v] / static_cast<double>(loop.size());
    uvs.push_back(middle);
    // The chart lies on the left of the loop, the hole on its right.
    for (std::size_t k = 0; k < loop.size(); ++k) fill({loop[(k + 1) % loop.size()], loop[k], hidden});
  }
  out.fixed.assign(uvs.size(), 0);
  for (const int v : chart.boundary_loops[longest_loop(chart)]) out.fixed[v] = 1;
  return out;
}

Mat2 square_root(const Mat2& positive) {
  const Eigen::SelfAdjointEigenSolver<Mat2> eigen(positive);
  return eigen.operatorSqrt();
}

/// The UVs under the linear map with which they have the least E_d: a ribbon's disk becomes a long ellipse. With J the Jacobians,
/// M = sum of area J J^T and N = sum of area (J J^T)^-1 the sum tr(S M) + tr(S^-1 N) is least where S, the map's square, is
/// the geometric mean of M^-1 and N.
Chart stretched(Chart chart) {
  Mat2 m = Mat2::Zero(), n = Mat2::Zero();
  for (std::size_t t = 0; t < chart.triangles.size(); ++t) {
    const Triangle& v = chart.triangles[t];
    const Mat2 j = jacobian(chart.surface[t].inverse_edges, chart.uvs[v[0]], chart.uvs[v[1]], chart.uvs[v[2]]);
    const Mat2 square = j * j.transpose();
    m += chart.surface[t].area * square;
    n += chart.surface[t].area * square.inverse();
  }
  const Mat2 root = square_root(m);
  const Mat2 inverse = root.inverse();
  const Mat2 map = square_root(inverse * square_root(root * n * root) * inverse);
  if (!map.allFinite()) return chart;
  for (Vec2& uv : chart.uvs) uv = map * uv;
  return chart;
}

/// Where rounding makes that invalid, as it is.
Chart validly_stretched(const Chart& chart) {
  Chart better = stretched(chart);
  return certify_charts({better}).valid() ? better : chart;
}

/// The disk with its parts evened out; nothing where that made it invalid.
std::optional<Chart> evened(const Chart& disk, const Filling& filling, bool valid, int threads, Monitor& monitor) {
  std::vector<Vec2> filled = disk.uvs;
  Tangle tangle = filled_disk(disk, filling, filled);
  tangle.stays_positive = valid && all_guards_hold(disk);
  auto uvs = untangle(tangle, std::move(filled), threads, monitor);
  if (!uvs) return std::nullopt;
  uvs->resize(disk.vertex_count());
  Chart even = disk;
  even.uvs = std::move(*uvs);
  if (!certify_charts({even}).valid()) return std::nullopt;
  return even;
}

Chart without_guards(Chart chart) {
  chart.guards.clear();
  return chart;
}

/// Tutte's embedding of the polygons, all convex; where that has flat triangles, as it has around vertices of two polygons only,
/// that of their triangles.
Chart tutte_start(const Chart& chart, const Filling& filling) {
  Chart disk = chart;
  disk.uvs = tutte_disk(chart, filling);
  if (chart.guards.empty() || certify_charts({disk}).valid()) return disk;
  disk.uvs = tutte_disk(without_guards(chart), filling);
  return disk;
}

/// A valid start. Tutte's embedding is one but for rounding, yet parts that it shrinks too much would hold the way down up: those
/// are evened out first.
std::optional<Chart> on_disk(const Chart& chart, const Filling& filling, int threads, Monitor& monitor) {
  const Chart disk = tutte_start(chart, filling);
  const bool valid = certify_charts({disk}).valid();
  if (valid && dirichlet_sums(without_guards(stretched(disk))).best_energy() < kGentle) return disk;
  if (const auto even = evened(disk, filling, valid, threads, monitor)) return even;
  if (!disk.guards.empty()) {
    if (const auto even = evened(without_guards(disk), filling, valid, threads, monitor)) return even;
  }
  if (!valid) return std::nullopt;
  return disk;
}

/// A fan draws a long flap into its one vertex, beyond what doubles can tell apart.
std::optional<Chart> on_disk(const Chart& chart, int threads, Monitor& monitor) {
  const std::size_t outer = longest_loop(chart);
  auto disk = on_disk(chart, fill_by_fans(chart, outer), threads, monitor);
  if (disk || chart.boundary_loops.size() == 1) return disk;
  return on_disk(chart, fill_as_in_uvs(chart, outer), threads, monitor);
}

/// The shapes that the chart has in its UVs, at the surface's scale.
Objective shapes_of_uvs(const Chart& chart, const std::vector<Chart>& pieces) {
  return make_objective(pieces, {.reference_uvs = {chart.uvs}, .reference_scale = {sums_of_good(chart).best_scale()}});
}

ReduceResult downhill(const Chart& chart, const Objective& objective, double settled, int threads, Monitor& monitor) {
  // Shapes may be kept all but exactly: no part of a distortion that is nothing is worth a wait.
  constexpr double kNegligible = 1e-6;
  const std::vector<Chart> charts = {chart};
  const ReduceProblem problem{.charts = charts,
                              .objective = &objective,
                              .gap = {.value = kGapForLargerBox * Gap{}.value},
                              .least_change = settled,
                              .negligible = kNegligible,
                              .most_energy = kCollapsed,
                              .threads = threads};
  return reduce_distortion(problem, [&](const ReduceProgress& progress) {
    // The energy falls from far above to near 1: its logarithm tells how far the way is.
    monitor.report(1 - (std::log10(1e-3 + progress.energy - 1) + 3) / 12);
    return true;  // nothing valid is there before this has ended
  });
}

/// The way down on coarse charts, as far as they can follow. Coarse triangles of a distorted start bend it roughly only; where
/// they have bent it much, those of what comes of it are better shaped.
Chart coarsely_downhill(Chart chart, const Sample& sample, const Objective& objective, int threads, Monitor& monitor) {
  constexpr int kMostRounds = 2;
  constexpr double kBentLittle = 0.5;  // of E_d - 1: where more than this is left
  for (int round = 0; round < kMostRounds; ++round) {
    const auto coarse = coarsen({chart}, objective, {}, &sample);
    if (!coarse) return chart;
    const PlacedCharts rough = restricted(*coarse, {.charts = {chart}});
    const ReduceResult end = downhill(rough.charts.front(), coarse->objective, kSettled, threads, monitor);
    if (!(end.energy <= kCollapsed)) return chart;
    auto uvs = prolonged(*coarse, {chart}, objective, end.uvs);
    if (!uvs) return chart;
    chart.uvs = std::move(uvs->front());
    if (end.energy - 1 > kBentLittle * (end.first_energy - 1)) break;
  }
  chart.uvs = relax_crushed(chart, {objective.inverse_edges, objective.weight}, objective.unit);
  return chart;
}

/// A valid start whose parts have their sizes, from fewer triangles that have found theirs: Tutte's embedding of all of them
/// would have to be evened out first.
std::optional<Chart> from_decimated(const Chart& chart, const Sample& sample, int threads, Monitor& monitor) {
  const auto coarse = decimate(chart, sample);
  if (!coarse) return std::nullopt;
  const auto disk = on_disk(coarse->mesh, threads, monitor);
  if (!disk) return std::nullopt;
  const Chart start = validly_stretched(*disk);
  const ReduceResult end = downhill(start, make_objective({start}), kRoughlySettled, threads, monitor);
  if (!(end.energy <= kCollapsed)) return std::nullopt;
  auto uvs = put_back(*coarse, end.uvs[0], threads);
  if (!uvs) return std::nullopt;
  Chart out = chart;
  out.uvs = std::move(*uvs);
  if (!certify_charts({out}).valid()) return std::nullopt;
  return out;
}

}  // namespace

std::optional<Spread> spread_out(const Chart& chart, int threads, Monitor& monitor) {
  std::optional<Chart> start;
  Spread out;
  if (has_many(chart)) {
    out.sample = sample_of_coarse(chart, spacing_inside(chart.surface.area()));
    start = from_decimated(chart, *out.sample, threads, monitor);
  }
  if (!start) start = on_disk(chart, threads, monitor);
  if (!start) return std::nullopt;
  drop_broken_guards(*start);
  out.chart = validly_stretched(*start);
  return out;
}

std::optional<Chart> embed(const Chart& chart, const Spread& start, Shapes shapes, int threads, Monitor& monitor) {
  const Objective objective = shapes == Shapes::OfUvs ? shapes_of_uvs(chart, {start.chart}) : make_objective({start.chart});
  const Chart from = start.sample ? coarsely_downhill(start.chart, *start.sample, objective, threads, monitor) : start.chart;
  ReduceResult result = downhill(from, objective, kSettled, threads, monitor);
  if (!(result.energy <= kCollapsed)) return std::nullopt;
  // The start may have had polygons that were not convex and had no guards; those that are in the end are guarded from here on.
  Chart embedded = chart;
  embedded.uvs = std::move(result.uvs[0]);
  embedded = convex_again(embedded, false, threads, monitor);
  drop_broken_guards(embedded);
  return embedded;
}

}  // namespace atlas_refine
