// The certificate without which no result leaves the library, made on the values that are stored.
#pragma once

#include "atlas_refine/result.h"
#include "cut/cut_atlas.h"
#include "report/measure_atlas.h"

namespace atlas_refine {

/// An atlas as it will be stored, and what is true of it.
struct CertifiedAtlas {
  std::vector<std::vector<Vec2>> uvs;  ///< of each piece
  Measures after;                      ///< but for seams
  SeamCount seams;
  Triangulations triangulations;
  int worse_faces = 0;      ///< faces of which a division that was positive in the input no longer is
  int mirrored_pieces = 0;  ///< cut from charts whose faces are wound both ways
  std::vector<ChartReport> charts;
  std::vector<PieceReport> pieces;  ///< only where the atlas was cut
  std::vector<Chart> stored;        ///< the pieces in units of the texture, on their surfaces
};

/// Scales the pieces into the unit square at the input's origin, or to the density that is asked, rounds their UVs as they will
/// be stored, and tests just those values with exact predicates: every triangle and guard positive, no borders crossing or
/// touching, the gap kept, the seams those that were meant. Pure: the same arguments give the same answer. Throws
/// RefineError(NotCertified).
CertifiedAtlas certify(const InputAtlas& input, const CutAtlas& atlas, const Gap& gap, const RefineOptions& options);

/// Numbers of the charts with faces that have an area until their UVs are rounded as they will be stored: smaller ones than
/// single precision tells apart.
std::vector<int> charts_lost_to_rounding(const InputAtlas& input, const CutAtlas& atlas, const RefineOptions& options);

/// Reports of the input's charts where nothing was done to them.
std::vector<ChartReport> reports_of_input(const InputAtlas& input);

}  // namespace atlas_refine
