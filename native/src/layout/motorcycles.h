// Motorcycle graphs: which trails of Q are driven, in which order, and the rectangles that they leave (section 3.2).
#pragma once

#include <vector>

#include "layout/quad_mesh.h"
#include "support/rng.h"

namespace atlas_refine {

/// One choice for one chart. Trails are driven in ascending order of rank; each stops at the boundary or at a trail driven
/// before. Differs from motorcycles that start together: a permutation of who passes first stands for their speeds. Every graph
/// without a cycle of mutual stops can be had this way.
struct MotorcycleGraph {
  std::vector<char> driven;  ///< per trail of Q
  std::vector<double> rank;  ///< per trail of Q
};

/// What is left when the motorcycles have stopped.
struct Decomposition {
  std::vector<Box> rectangles;     ///< in the chart's coordinates; those of a chart that overlaps itself may overlap
  std::vector<double> areas;       ///< of the chart within each
  std::vector<TrailStart> trails;  ///< in the order they are driven, those that went nowhere left out
  double cut_length = 0;           ///< on the surface
};

/// The shortest trail of each corner, short ones first.
MotorcycleGraph shortest_graph(const QuadMesh& quads);
/// The same, and of every extra corner whose trail is shorter than a square of the chart's area: a long chart in short parts.
MotorcycleGraph graph_across(const QuadMesh& quads);
/// Directions and ranks at random. At least one of every two consecutive trails of a corner is driven: floor(n / 2) to n of n.
MotorcycleGraph random_graph(const QuadMesh& quads, Rng& rng);
/// One corner chooses anew, or one trail gets another rank.
void mutate(const QuadMesh& quads, MotorcycleGraph& graph, Rng& rng);

Decomposition drive(const QuadMesh& quads, const MotorcycleGraph& graph);

}  // namespace atlas_refine
