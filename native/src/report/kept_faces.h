// Faces that stay as they are where charts were cut along their edges.
#pragma once

#include <array>
#include <vector>

#include "atlas_refine/options.h"
#include "cut/cut_atlas.h"
#include "input/split_charts.h"

namespace atlas_refine {

/// Whether cuts may divide faces; else they run along edges only, and the faces are the input's.
inline bool divides_faces(const RefineOptions& options) { return options.cut == Cut::Split && options.seams != Seams::None; }

/// For each corner of the input the piece and the vertex of it that it became, -1 where its chart has no piece. No vertex may be
/// new, no face divided.
std::vector<CornerRef> corners_on_pieces(const Atlas& atlas, const ChartSet& set, const CutAtlas& cut);

/// The seams as pairs of the input's vertices.
std::vector<std::array<int, 2>> seams_as_vertices(const Atlas& atlas, const ChartSet& set, const CutAtlas& cut);

}  // namespace atlas_refine
