// What is different where the box is the texture: PE is what is covered of it, and the gap keeps a border free.
#pragma once

#include "atlas_refine/options.h"
#include "geometry/freedom.h"
#include "report/journal.h"
#include "report/measure_atlas.h"

namespace atlas_refine {

/// What the charts, or the fixed ones of them alone, cover of the texture whose corner is at `origin`.
double share_of_texture(const std::vector<Chart>& charts, const Freedoms& freedom, const Vec2& origin, double box_aspect,
                        bool fixed_only);

/// The box is the texture: with fixed charts, and where that is asked.
bool is_in_texture(const Freedoms& freedom, const RefineOptions& options);

/// What is kept free along the texture's border, in units of its height: the gap, where one is given, and a little for
/// rounding.
double border_of(const RefineOptions& options);
inline constexpr double kBorderSpare = 1e-6;

/// Charts that are to have `uv_density`. In a texture: what they cover of it so is the bound; where that is more than the bound
/// they fill it, and have the size that comes of it. A gap that is given is one of the texture, however much of their box charts
/// cover that are moved. With `ample` they may cover more of it after they were bent as well: they are then brought to their
/// size, so `spare` tells how much larger they may have become at most, and the gap becomes larger by it. In a free box: a gap in
/// parts of the long side is meant of [0, 1]^2, and becomes one of the box, as if that were square and full; so it is at least
/// what is asked, up to a tenth of the box, which is told. Needs the origin.
RefineOptions settle_density(RefineOptions options, InputAtlas& input, Journal& journal, bool ample);

/// The same options for the box within that border: its aspect, and bound and gap, which has that little more too, as fractions
/// of it. Throws RefineError(BoundNotReached) where it cannot hold the bound and no best effort is asked for.
RefineOptions within_border(RefineOptions options);

/// Where the box is the texture, whose corner is at `origin`, PE is what the charts cover of it. The charts are in units of the
/// texture, where the UVs lie.
void measure_in_texture(const std::vector<Chart>& placed, const Freedoms& freedom, const Vec2& origin,
                        const RefineOptions& options, Measures& measures);

/// An atlas whose box is the texture in the coordinates of the box within its border, whose height is 1, without the defects of
/// fixed charts, measured in the texture.
void put_in_texture(InputAtlas& input, const RefineOptions& options);

/// Every chart that is not fixed lies in the texture, whose corner is at 0, or less than `slack` outside of it.
bool lies_in_texture(const std::vector<Chart>& charts, const Freedoms& freedom, double box_aspect, double slack = 0);

}  // namespace atlas_refine
