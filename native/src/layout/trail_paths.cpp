// Tracing all trails, then reading their paths: later trails add vertices to earlier ones.
#include "layout/trail_paths.h"

namespace atlas_refine {

TracedTrails trace_trails(const std::vector<AxisAlignedChart>& aligned, const std::vector<std::vector<TrailStart>>& trails) {
  TracedTrails out;
  for (std::size_t c = 0; c < aligned.size(); ++c) {
    SplitMesh& mesh = out.meshes.emplace_back(aligned[c].mesh);
    if (aligned[c].boundary.empty()) continue;
    TrailTracer tracer(mesh, aligned[c].boundary, aligned[c].quarter_turns);
    for (const TrailStart& start : trails[c]) tracer.hold(start.vertex);
    std::vector<int> ends;
    for (const TrailStart& start : trails[c]) ends.push_back(tracer.trace(start, TrailTracer::Until::BoundaryOrTrail).back());
    for (std::size_t t = 0; t < ends.size(); ++t) out.paths.push_back({static_cast<int>(c), tracer.path(trails[c][t], ends[t])});
  }
  return out;
}

}  // namespace atlas_refine
