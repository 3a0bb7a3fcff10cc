// Measures and certificate of an atlas that is split already.
#pragma once

#include "atlas_refine/measures.h"
#include "atlas_refine/options.h"
#include "geometry/freedom.h"
#include "input/join_edges.h"
#include "input/split_charts.h"

namespace atlas_refine {

/// The input as all stages see it. UVs are in units of the texture: of a texture of W:H, which [0, 1]^2 stands for, u is
/// stretched by W / H, so that lengths, areas and distortion are those on the texture; nothing changes where the aspect is free
/// or square.
struct InputAtlas {
  const Atlas& atlas;  ///< the whole mesh
  ChartSet set;        ///< of the charts that take part
  Measures measures = {};
  Vec2 origin = Vec2::Zero();   ///< lower left corner of the box that the result fills
  double spare = 1;             ///< of settle_density(), by which it has made the gap larger
  bool gap_of_texture = false;  ///< of the same: charts that cover more of their box than the bound lie in a larger one
  double size_rounding = 0;     ///< of the same: relative, of the size that UVs have once they are stored
};

/// All charts, each in units of its group's texture, not measured. Throws RefineError(BadInput) as split_charts() does.
InputAtlas read_atlas(const Atlas& atlas, const RefineOptions& options);

/// These charts of it as an atlas of their own, measured.
InputAtlas part_of(const InputAtlas& whole, const std::vector<int>& charts, double box_aspect);

/// Of all parts: the least PE, box and gaps, the means of distortion by area, sums and maxima of the rest. Seams are left out.
Measures combined(const std::vector<Measures>& parts, const std::vector<double>& areas);

/// Edges in space that are no seams of the surface's own border but of the UV map, and their length.
struct SeamCount {
  int edges = 0;
  double length = 0;
  double open = 0;  ///< EdgeJoins::open_length
};
inline SeamCount seams_of(const EdgeJoins& joins) { return {joins.seam_edges, joins.seam_length, joins.open_length}; }
inline SeamCount seams_of(const ChartSet& set) { return {set.seam_edges, set.seam_length, set.open_length}; }

/// Sets what is measured on seams.
void measure_seams(const Atlas& atlas, const SeamCount& seams, Measures& measures);

/// UVs in units of the texture.
void stretch_to_texture(Chart& chart, double box_aspect);
void stretch_to_texture(std::vector<Chart>& charts, double box_aspect);

/// All of Measures but seams and distortion_to_input, which is 1. The charts are in units of the texture.
Measures measure_split(const ChartSet& set, double box_aspect);

Validity validate_split(const ChartSet& set, const Freedoms& freedom = {});

/// How many faces are not positive under each division.
Triangulations count_readings(const std::vector<FaceReading>& readings);

}  // namespace atlas_refine
