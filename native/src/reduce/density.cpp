// Scales of charts, or of the surface that they are measured against.
#include "reduce/density.h"

#include <algorithm>

#include "measure/distortion.h"

namespace atlas_refine {

bool set_density(std::vector<Chart>& charts, Density density) {
  double least = 0, most = 0;
  for (Chart& chart : charts) {
    const double scale = dirichlet_sums(chart).best_scale();
    if (density == Density::Equal) {
      for (Vec2& uv : chart.uvs) uv *= scale;
    } else {
      for (RestTriangle& rest : chart.rest) {
        rest.inverse_edges *= scale;
        rest.area /= scale * scale;
      }
    }
    least = least == 0 ? scale : std::min(least, scale);
    most = std::max(most, scale);
  }
  return density == Density::Equal && most > 1.001 * least;
}

}  // namespace atlas_refine
