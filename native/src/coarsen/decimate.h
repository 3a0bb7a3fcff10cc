// A chart on fewer triangles that needs no UVs: vertices are removed on the surface, one after the other, and put back in the
// plane.
#pragma once

#include <optional>
#include <vector>

#include "coarsen/sample_vertices.h"
#include "geometry/chart.h"

namespace atlas_refine {

/// A vertex that was removed, all of whose neighbours were then joined to one of them.
struct Removal {
  int vertex;       ///< of the chart
  int onto;         ///< the entry of the ring that the others were joined to
  int first, size;  ///< of the ring in the arrays of its Decimation
};

struct Decimation {
  Chart mesh;             ///< without UVs and guards; its surface is what is left of the chart's
  std::vector<int> kept;  ///< per vertex: the chart's vertex it is
  std::vector<Removal> removals;
  std::vector<int> passes;  ///< the first removal of each: no two of one are neighbours
  /// Neighbours of removed vertices, counterclockwise; how far they were from the vertex; how far from the next neighbour.
  std::vector<int> ring;
  std::vector<float> spokes, rims;
};

/// Keeps the vertices of the sample. Lengths across what was removed are told where its triangles are laid flat around it.
/// Nothing where less than half of the vertices go.
std::optional<Decimation> decimate(const Chart& chart, const Sample& sample);

/// UVs of the chart from positive ones of the decimated mesh: each vertex comes back where its triangles are positive and their
/// distortion is least. Nothing where rounding left no such place.
std::optional<std::vector<Vec2>> put_back(const Decimation& decimation, const std::vector<Vec2>& coarse_uvs, int threads);

}  // namespace atlas_refine
