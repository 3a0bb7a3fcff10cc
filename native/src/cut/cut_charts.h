// Cutting charts along their trails, triangles divided, so that the mesh in space stays closed (section 3.2, "Cutting").
#pragma once

#include <array>
#include <vector>

#include "geometry/axis_aligned_chart.h"
#include "geometry/axis_trails.h"

namespace atlas_refine {

/// A point of the surface that was no vertex before.
struct NewPoint {
  int chart;
  Support support;  ///< two or three vertices of one triangle of that chart
};

/// A connected part of a chart after cutting.
struct CutPiece {
  int chart;                      ///< it is part of
  Chart mesh;                     ///< UVs where the aligned chart lies
  std::vector<int> vertices;      ///< per vertex: the chart's vertex it stands for, -1 where it is new
  std::vector<int> points;        ///< per vertex: index into CutCharts::points, -1 where it is not new
  std::vector<int> sources;       ///< per triangle: the chart's triangle it is part of
  std::vector<Support> supports;  ///< per vertex: where on the chart it lies
};

struct CutCharts {
  std::vector<CutPiece> pieces;
  std::vector<NewPoint> points;
  /// Edges that were cut, each once: a chart and two of its vertices, or ~k for points[k].
  struct Seam {
    int chart;
    std::array<int, 2> ends;
  };
  std::vector<Seam> seams;
};

std::vector<Chart> meshes_of(const CutCharts& cut);
std::vector<int> charts_of(const CutCharts& cut);  ///< of each piece

/// Drives each chart's trails in order, each to the boundary or to a trail before it, and takes the charts apart along them.
/// `space_points` tells for every vertex of every chart which point in space it is: where a boundary edge is divided, all edges
/// at the same place in space are divided likewise.
CutCharts cut_charts(const std::vector<AxisAlignedChart>& aligned, const std::vector<Chart>& sources,
                     const std::vector<std::vector<TrailStart>>& trails, const std::vector<std::vector<int>>& space_points);

}  // namespace atlas_refine
