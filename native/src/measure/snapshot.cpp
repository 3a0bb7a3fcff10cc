// The charts of one stage as a picture's data.
#include "measure/snapshot.h"

#include "measure/distortion.h"

namespace atlas_refine {

AtlasSnapshot make_snapshot(std::string stage, std::string caption, const std::vector<Chart>& charts, const Box& box) {
  AtlasSnapshot snapshot;
  snapshot.stage = std::move(stage);
  snapshot.caption = std::move(caption);
  snapshot.box_min = box.min;
  snapshot.box_max = box.max;
  const double scale = dirichlet_sums(charts).best_scale();
  for (const Chart& chart : charts) {
    const int first = static_cast<int>(snapshot.uvs.size());
    snapshot.uvs.insert(snapshot.uvs.end(), chart.uvs.begin(), chart.uvs.end());
    for (const Triangle& t : chart.triangles) snapshot.triangles.push_back({first + t[0], first + t[1], first + t[2]});
    for (std::vector<int> loop : chart.boundary_loops) {
      for (int& vertex : loop) vertex += first;
      snapshot.boundary_loops.push_back(std::move(loop));
    }
    const std::vector<double> stretch = triangle_stretch(chart, scale);
    snapshot.stretch.insert(snapshot.stretch.end(), stretch.begin(), stretch.end());
  }
  return snapshot;
}

}  // namespace atlas_refine
