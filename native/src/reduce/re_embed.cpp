// Bijective re-embedding of one chart.
#include "reduce/re_embed.h"

#include <cmath>

#include "atlas_refine/error.h"
#include "geometry/half_edge_mesh.h"
#include "geometry/tutte.h"
#include "measure/certificate.h"
#include "reduce/reduce.h"

namespace atlas_refine {

Chart re_embed(const Chart& chart, int chart_index, int threads, Monitor& monitor) {
  const auto fail = [&](const std::string& why) {
    return RefineError(ErrorCode::BadInput, "embed", "chart " + std::to_string(chart_index) + " overlaps itself and " + why, chart_index,
                       chart.triangle_faces.front());
  };
  const int euler = mesh_topology(chart.vertex_count(), chart.triangles).euler_characteristic;
  if (euler + static_cast<int>(chart.boundary_loops.size()) != 2) throw fail("has a handle: no embedding without a cut exists");
  std::vector<Chart> start = {chart};
  start[0].uvs = tutte_disk(chart);
  if (const Validity valid = certify_charts(start); !valid.valid()) throw fail("Tutte's embedding of it is not exact: " + valid.problem);
  const double before = std::log(1e-3);
  const ReduceProblem problem{.charts = start, .gap = {}, .threads = threads};
  const ReduceResult result = reduce_distortion(problem, [&](const ReduceProgress& progress) {
    monitor.report(1 - std::log(1e-3 + progress.energy - 1) / -before);
  });
  start[0].uvs = result.uvs[0];
  return start[0];
}

}  // namespace atlas_refine
