// Charts that are locked: left where they are, excused from what is asked of the others, and stored to the bit.
#pragma once

#include <string>

#include "atlas_refine/result.h"
#include "cut/cut_atlas.h"
#include "geometry/freedom.h"
#include "input/stacks.h"
#include "report/measure_atlas.h"

namespace atlas_refine {

/// What the options allow with each chart.
Freedoms freedom_of(const ChartSet& set, const RefineOptions& options);

/// What each piece's chart allows.
Freedoms freedom_of_pieces(const Freedoms& of_charts, const CutAtlas& atlas);

/// Defects of fixed charts do not count, and those that are mirrored stay so.
void excuse_fixed(ChartSet& set, const Freedoms& freedom);

/// Writes the input's UVs of fixed charts over those of the pieces that they are.
void restore_fixed(const InputAtlas& input, const CutAtlas& atlas, const Freedoms& freedom, std::vector<std::vector<Vec2>>& uvs);

/// Corners of locked charts get what they had, also where noise made corners of one vertex differ.
void restore_locked_corners(const InputAtlas& whole, const RefineOptions& options, RefineResult& result);

/// Charts that lie on others take their shapes: those on which a chart with a kept shape lies keep theirs.
RefineOptions with_kept_leaders(const ChartSet& set, const std::vector<Follower>& followers, RefineOptions options);

/// What keeps charts from giving way, in words that follow a message; empty where all bend.
std::string words_on_kept(const std::vector<Chart>& charts, const Freedoms& freedom, double box_aspect);

}  // namespace atlas_refine
