// The validity certificate: exact predicates on the values that are stored.
#pragma once

#include <vector>

#include "atlas_refine/measures.h"
#include "geometry/freedom.h"

namespace atlas_refine {

/// Two points of one boundary loop are "far apart" where the boundary between them is at least this fraction of the box diagonal
/// long: ten times the default gap of 0.0025. Nearer ones are corners and wiggles of one border, not two borders that face.
inline constexpr double kFarArc = 10 * 0.0025;

/// Exact check of placed charts: every triangle strictly positive, no two boundary edges (of one chart or of two) that cross
/// or touch except neighbours at their common vertex. `points` tells for every vertex of every chart which point in space it is:
/// with them boundary vertices of one chart that are one point there may lie at one point here too (a pinch), where their faces
/// stay apart; without, that is a contact. Also finds charts that lie wholly inside another chart's interior, and
/// charts that overlap themselves without crossing boundaries. Counting of crossings stops at 10000.
/// `chart` and `face` of the answer are Chart::number, or the index in `charts` where that is -1, and of Chart::triangle_faces.
/// Fixed charts may be as they like, and on each other: only what others do to them is looked at.
Validity certify_charts(const std::vector<Chart>& charts, const std::vector<std::vector<int>>& points = {},
                        const Freedoms& freedom = {});

/// Smallest distance between boundaries of two different charts that are not both fixed, absolute; infinity with fewer than two
/// charts.
double gap_between_charts(const std::vector<Chart>& charts, const Freedoms& freedom = {});

/// For each chart the smallest distance, absolute, between a boundary vertex and a boundary edge of the same loop that face
/// each other through the outside and between which the boundary, measured on the surface, is at least `far_arc` long. Sought up
/// to the distance `reach`; infinity where there is none.
std::vector<double> gap_within_charts(const std::vector<Chart>& charts, double far_arc, double reach);

/// The least of these with kFarArc; it and `reach` are fractions of the diagonal of the charts' box. `best_scale`: of
/// DirichletSums.
double gap_within(const std::vector<Chart>& charts, double best_scale, double reach);

}  // namespace atlas_refine
