// A chart on fewer triangles: its boundary as it is, inside some of its vertices.
#pragma once

#include <optional>

#include "coarsen/locate.h"
#include "coarsen/sample_vertices.h"
#include "geometry/chart.h"
#include "solve/objective.h"

namespace atlas_refine {

struct CoarseChart {
  Chart mesh;                 ///< without guards; its surface tells the lengths of the boundary
  std::vector<int> kept;      ///< per vertex: the fine chart's vertex it is
  std::vector<Place> places;  ///< per vertex of the fine chart: where it lies
};

/// The vertices that a coarse chart keeps. They depend on no UVs.
Sample sample_of_coarse(const Chart& chart, double spacing);

/// The chart on the vertices of its sample. Nothing where less than half of its vertices would be saved. It must be free of flips
/// and crossings.
std::optional<CoarseChart> coarsen(const Chart& chart, Sample sample);

/// The part of an objective that stands for the elements of one chart: its triangles, then its guards.
struct ChartObjective {
  std::vector<Mat2> inverse_edges;
  std::vector<double> weight;
};

/// Of the coarse triangles: each has the shape that its elements have their least energy in, together, and weighs what they weigh
/// times that energy. So the optimum and the energy there are those of the fine chart, as far as coarse triangles can bend.
ChartObjective coarse_objective(const Chart& chart, const CoarseChart& coarse, const ChartObjective& fine);

}  // namespace atlas_refine
