// One UV for each vertex where those of its corners differ by noise.
#pragma once

#include <vector>

#include "input/triangulate_faces.h"

namespace atlas_refine {

/// `uvs` holds for each vertex of each chart the value of its first corner, `points` its point in space. Where that would turn a
/// face over at one of the vertex's corners, another corner's value or their mean is taken, whatever turns the fewest. Vertices
/// of one chart at one point in space whose UVs differ by noise (a pinch) get the value of the first, where no face turns.
void settle_noise(const Atlas& atlas, const std::vector<CornerRef>& corners, const std::vector<std::vector<int>>& points,
                  std::vector<std::vector<Vec2>>& uvs);

}  // namespace atlas_refine
