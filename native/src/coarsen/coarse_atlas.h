// All charts of an atlas coarsened, with their objective.
#pragma once

#include <optional>
#include <vector>

#include "coarsen/coarse_chart.h"
#include "geometry/freedom.h"

namespace atlas_refine {

struct CoarseAtlas {
  std::vector<std::optional<CoarseChart>> charts;  ///< nothing where a chart stays as it is
  Objective objective;                             ///< of the coarse charts
};

/// How far apart a coarse chart's vertices are where they are far from its boundary; `area`: of all coarse charts' surface.
double spacing_inside(double area);

/// Nothing where the atlas is small, or too little of it can be coarsened. Charts that do not bend stay as they are.
/// `of_only_chart`: where there is but one, and it is known.
std::optional<CoarseAtlas> coarsen(const std::vector<Chart>& charts, const Objective& objective, const Freedoms& freedom,
                                   const Sample* of_only_chart = nullptr);

/// The coarse charts where the fine ones lie.
PlacedCharts restricted(const CoarseAtlas& coarse, const PlacedCharts& fine);

/// UVs of the fine charts, from those of the coarse ones. `objective` and `fine`: the fine charts, as coarsen() had them. Nothing
/// where triangles that turned over could not be mended.
std::optional<std::vector<std::vector<Vec2>>> prolonged(const CoarseAtlas& coarse, const std::vector<Chart>& fine,
                                                        const Objective& objective,
                                                        const std::vector<std::vector<Vec2>>& coarse_uvs);

}  // namespace atlas_refine
