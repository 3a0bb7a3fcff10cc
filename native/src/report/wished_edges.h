// Edges that the caller has wishes for, and that the mesh does not have.
#pragma once

#include "atlas_refine/atlas.h"
#include "atlas_refine/options.h"
#include "report/journal.h"

namespace atlas_refine {

/// Warns of pairs in no_seam and prefer_seam that are no edge of a face, by the places of their ends: they come to nothing.
void tell_of_missing_edges(const Atlas& atlas, const RefineOptions& options, Journal& journal);

}  // namespace atlas_refine
