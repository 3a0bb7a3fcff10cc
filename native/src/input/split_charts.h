// Input to charts (section 3, "Inputs"): UV connectivity, mirrored charts turned, flips counted.
#pragma once

#include <array>
#include <vector>

#include "geometry/chart.h"
#include "input/face_defect.h"
#include "input/join_edges.h"
#include "input/triangulate_faces.h"

namespace atlas_refine {

/// An edge along which what was one chart, folded there, was parted.
struct FoldEdge {
  std::array<int, 2> charts;               ///< at either side of it
  std::array<std::array<int, 2>, 2> ends;  ///< at each end the vertices of the two charts
  int corner;                              ///< of the input, where the first chart's side of it starts
};

/// Charts that were one, folded along edges in the UV plane.
struct Fold {
  std::vector<int> charts;
  std::vector<FoldEdge> edges;
};

/// The input atlas as charts. Chart UVs are the input's values, except that mirrored charts are turned over (u negated); where
/// those of one vertex differ by noise they are one of its corners' or their mean.
struct ChartSet {
  std::vector<Chart> charts;       ///< ordered by their smallest input face
  std::vector<CornerRef> corners;  ///< one per input corner; chart -1 where it is of none of these charts
  std::vector<std::vector<int>>
      points;                       ///< one per vertex of each chart: the point in space where it lies, equal for equal positions
  std::vector<bool> mirrored;       ///< one per chart
  std::vector<bool> mixed_winding;  ///< one per chart: neighbouring faces run along their edge in the same sense
  std::vector<Fold> folds;          ///< what had to be parted, by its first chart
  std::vector<FaceDefect> defects;  ///< faces whose triangles are not all positive; empty for a usable atlas
  std::vector<FaceReading> readings;  ///< one per input face
  int seam_edges = 0;                 ///< edges in space between two faces or more that are not joined in the UV map, nor folds
  double seam_length = 0;             ///< their length in space, each once, without natural boundary
  double open_length = 0;             ///< EdgeJoins::open_length
};

/// Splits an atlas by UV connectivity, as join_edges() has it: faces that share an edge (by vertex, or by equal positions) with
/// one UV at either end belong together. Faces of opposite winding are joined too, so that no seam arises where the UVs have
/// none. As meant, UVs are one also where they differ by noise, and charts folded along a line are parted there; exact, neither
/// is done. A chart is mirrored where the larger part of it, by area in space, is. Polygons are triangulated here: as their
/// reader does it (Atlas::triangles), else as a fan where that is positive in the UV plane, consistent in space and free of
/// slivers, else by a triangulation of the UV polygon. Throws RefineError(BadInput) for arrays that do not fit together, indices
/// out of range, NaN or no faces.
/// `groups`: one number per face, or empty; faces of different ones share no chart.
ChartSet split_charts(const Atlas& atlas, Joining joining = Joining::AsMeant, const std::vector<int>& groups = {},
                      int threads = 1);

/// These charts of the set alone, in this order; `seam_edges` and the lengths are not theirs and stay 0.
ChartSet select_charts(const ChartSet& set, const std::vector<int>& charts);

/// The same charts where the input's UVs lie: mirrored charts are turned back, their triangles still counterclockwise.
std::vector<Chart> charts_as_placed(const ChartSet& set);

}  // namespace atlas_refine
