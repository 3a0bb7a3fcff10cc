// What the options ask of the pieces: relative scale, shapes to keep, faces that matter (section 3.4, section 4 "Local control").
#pragma once

#include <vector>

#include "atlas_refine/options.h"
#include "cut/cut_atlas.h"
#include "geometry/freedom.h"
#include "solve/objective.h"

namespace atlas_refine {

/// UV length per surface length that each chart is to have. Equal: 1 for all. Keep: what it has in `input`, normalised so that
/// all charts together have the area of the surface, and their mean where it is mostly flipped or without area; whatever is done
/// to a chart later, it is to have that again.
std::vector<double> wanted_density(const std::vector<Chart>& input, Density density);

/// Scales each chart of `charts` as it is now to its wanted density. Equal scales to the chart's own optimum of E_d, keep to the
/// area. Fixed charts keep theirs. True where the others' relative scales changed by more than a thousandth.
bool set_density(std::vector<Chart>& charts, const std::vector<double>& wanted, Density density, const Freedoms& freedom = {});

/// UV area of each piece as it is to be where charts keep their densities, 0 of fixed ones; empty where they do not keep them.
std::vector<double> kept_areas(const std::vector<Chart>& input, const CutAtlas& atlas, const RefineOptions& options,
                               const Freedoms& freedom);

/// Pieces whose charts only move get the shapes of their charts in `input` back, to rounding: the similar image that is nearest
/// to what they are.
void restore_shapes(const std::vector<Chart>& input, const Freedoms& freedom, CutAtlas& atlas);

/// The objective of `atlas`, whose charts were `input`.
Objective goal_of(const std::vector<Chart>& input, const CutAtlas& atlas, const RefineOptions& options);

}  // namespace atlas_refine
