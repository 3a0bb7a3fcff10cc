// Edges that the caller has wishes for: which the mesh does not have, and which were cut all the same.
#pragma once

#include "atlas_refine/atlas.h"
#include "atlas_refine/options.h"
#include "cut/cut_atlas.h"
#include "cut/side_prices.h"
#include "report/journal.h"

namespace atlas_refine {

/// Warns of pairs in no_seam and prefer_seam that are no edge of a face, by the places of their ends: they come to nothing.
void tell_of_missing_edges(const Atlas& atlas, const RefineOptions& options, Journal& journal);

/// Warns of edges that must stay whole and that cuts run along or across: where faces are divided there may be no other way.
/// `sources`: what the pieces are parts of.
void warn_of_forbidden_edges(const std::vector<SidePrices>& prices, const std::vector<Chart>& sources, const CutAtlas& cut,
                             Journal& journal);

}  // namespace atlas_refine
