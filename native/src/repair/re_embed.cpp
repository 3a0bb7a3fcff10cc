// Bijective re-embedding of one chart.
#include "repair/re_embed.h"

#include <cmath>
#include <optional>

#include "atlas_refine/error.h"
#include "geometry/boundary.h"
#include "geometry/guards.h"
#include "geometry/half_edge_mesh.h"
#include "geometry/tutte.h"
#include "measure/certificate.h"
#include "measure/distortion.h"
#include "reduce/reduce.h"

namespace atlas_refine {
namespace {

// The disk that the embedding starts from has a smaller box than what comes out: ask for more than the default gap.
constexpr double kGapForLargerBox = 1.5;
// An embedding above this E_d has collapsed: Tutte's shrinks parts that hang on a narrow neck beyond what doubles can mend.
constexpr double kCollapsed = 100;

/// Boundary vertices within `tolerance` of a boundary edge they do not belong to, and the nearer ends of those edges.
std::vector<char> touching_vertices(const Chart& chart, double tolerance) {
  const Boundary boundary = make_boundary({chart}, {0});
  std::vector<char> touching(chart.vertex_count(), 0);
  for (const PointEdge& pair : near_pairs(boundary, chart.uvs, {}, tolerance)) {
    const int point = boundary.vertex[pair.point];
    const int start = boundary.vertex[pair.edge], end = boundary.vertex[boundary.next[pair.edge]];
    const Closest closest = closest_on_segment(chart.uvs[point], chart.uvs[start], chart.uvs[end]);
    if (closest.distance > tolerance) continue;
    touching[point] = 1;
    touching[closest.along < 0.5 ? start : end] = 1;
  }
  return touching;
}

/// The chart with the borders where it touches itself drawn a little into it; nothing where that does not make it valid.
std::optional<Chart> part_touching(const Chart& chart) {
  std::vector<Vec2> inward(chart.vertex_count(), Vec2::Zero());
  std::vector<int> count(chart.vertex_count(), 0);
  for (const Triangle& t : chart.triangles) {
    const Vec2 centre = (chart.uvs[t[0]] + chart.uvs[t[1]] + chart.uvs[t[2]]) / 3;
    for (int v : t) {
      inward[v] += centre - chart.uvs[v];
      ++count[v];
    }
  }
  const double size = uv_box({chart}).diagonal();
  for (const double tolerance : {0.0, 1e-6, 1e-5, 1e-4}) {
    const std::vector<char> touching = touching_vertices(chart, tolerance * size);
    for (const double share : {0.1, 0.02}) {
      Chart parted = chart;
      for (int v = 0; v < chart.vertex_count(); ++v) {
        if (touching[v]) parted.uvs[v] += share / count[v] * inward[v];
      }
      if (!certify_charts({parted}).valid()) continue;
      drop_broken_guards(parted);
      return parted;
    }
  }
  return std::nullopt;
}

}  // namespace

Chart re_embed(const Chart& chart, int chart_index, int threads, Monitor& monitor) {
  if (auto parted = part_touching(chart)) return *parted;
  const auto fail = [&](const std::string& why) {
    return RefineError(ErrorCode::BadInput, "embed", "chart " + std::to_string(chart_index) + " overlaps itself and " + why,
                       chart_index, chart.triangle_faces.front());
  };
  const int euler = mesh_topology(chart.vertex_count(), chart.triangles).euler_characteristic;
  if (euler + static_cast<int>(chart.boundary_loops.size()) != 2) throw fail("has a handle: no embedding without a cut exists");
  std::vector<Chart> start = {chart};
  start[0].uvs = tutte_disk(chart);
  if (const Validity valid = certify_charts(start); !valid.valid())
    throw fail("Tutte's embedding of it is not exact: " + valid.problem);
  drop_broken_guards(start[0]);
  const ReduceProblem problem{.charts = start, .gap = {.value = kGapForLargerBox * Gap{}.value}, .threads = threads};
  const ReduceResult result = reduce_distortion(problem, [&](const ReduceProgress& progress) {
    // E_d falls from far above to near 1: its logarithm tells how far the way is.
    monitor.report(1 - (std::log10(1e-3 + progress.energy - 1) + 3) / 12);
  });
  if (result.energy > kCollapsed) throw fail("no embedding of acceptable distortion was found");
  // Polygons that have become convex on the way are guarded from here on.
  Chart embedded = chart;
  embedded.uvs = result.uvs[0];
  drop_broken_guards(embedded);
  return embedded;
}

}  // namespace atlas_refine
