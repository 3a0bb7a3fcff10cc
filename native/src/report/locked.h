// Charts that are locked: left where they are, excused from what is asked of the others, and stored to the bit. And what else is
// different where the box is the texture.
#pragma once

#include <string>

#include "atlas_refine/result.h"
#include "geometry/freedom.h"
#include "input/stacks.h"
#include "report/measure_atlas.h"

namespace atlas_refine {

/// What the options allow with each chart.
Freedoms freedom_of(const ChartSet& set, const RefineOptions& options);

/// Defects of fixed charts do not count, and those that are mirrored stay so.
void excuse_fixed(ChartSet& set, const Freedoms& freedom);

/// The box is the texture: with fixed charts, and where that is asked.
bool is_in_texture(const Freedoms& freedom, const RefineOptions& options);

/// What is kept free along the texture's border, in units of its height: the gap, where one is given, and a little for rounding.
double border_of(const RefineOptions& options);
inline constexpr double kBorderSpare = 1e-6;

/// The same options for the box within that border: its aspect, and bound and gap as fractions of it. Throws
/// RefineError(BoundNotReached) where it cannot hold the bound and no best effort is asked for.
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

/// Writes the input's UVs of fixed charts over those of an atlas that was not cut, one array per chart.
void restore_fixed(const InputAtlas& input, const Freedoms& freedom, std::vector<std::vector<Vec2>>& uvs);

/// Corners of locked charts get what they had, also where noise made corners of one vertex differ.
void restore_locked_corners(const InputAtlas& whole, const RefineOptions& options, RefineResult& result);

/// Charts that lie on others take their shapes: those on which a chart with a kept shape lies keep theirs.
RefineOptions with_kept_leaders(const ChartSet& set, const std::vector<Follower>& followers, RefineOptions options);

/// What keeps charts from giving way, in words that follow a message; empty where all bend.
std::string words_on_kept(const std::vector<Chart>& charts, const Freedoms& freedom, double box_aspect);

}  // namespace atlas_refine
