// The tolerance of one atlas.
#include "input/uv_noise.h"

#include <algorithm>

namespace atlas_refine {

double uv_noise(const Atlas& atlas) {
  Vec2 low = atlas.corner_uvs[0], high = low;
  for (const Vec2& uv : atlas.corner_uvs) {
    low = low.cwiseMin(uv);
    high = high.cwiseMax(uv);
  }
  return kNoise * std::min(1.0, (high - low).maxCoeff());
}

}  // namespace atlas_refine
