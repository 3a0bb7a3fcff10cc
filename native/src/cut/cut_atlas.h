// An atlas as pieces on a surface: charts whole, divided, or cut into parts (section 3.2, "Cutting").
#pragma once

#include <array>
#include <span>
#include <vector>

#include "geometry/split_mesh.h"

namespace atlas_refine {

/// A point of the surface that was no vertex before.
struct SurfacePoint {
  int chart;
  Support support;  ///< two or three vertices of one triangle of that chart
};

/// A connected part of a chart, or the whole of it.
struct Piece {
  int chart;                      ///< of the input, that it is part of
  Chart mesh;                     ///< its surface is that part of the chart's
  std::vector<int> vertices;      ///< per vertex: the chart's vertex it stands for, -1 where it is new
  std::vector<int> points;        ///< per vertex: index into CutAtlas::points, -1 where it is not new
  std::vector<int> sources;       ///< per triangle: the chart's triangle it is part of
  std::vector<Support> supports;  ///< per vertex: where on the chart it lies
};

/// An edge of the surface that was whole in its chart and is cut: two vertices of the chart, or ~k for points[k].
struct Seam {
  int chart;
  std::array<int, 2> ends;
};

struct CutAtlas {
  std::vector<Piece> pieces;
  std::vector<SurfacePoint> points;
  std::vector<Seam> seams;    ///< each once
  Vec2 frame = Vec2::Zero();  ///< PlacedCharts::frame: what the unit square of the texture is to be; zero: the pieces' own box
};

/// A path along edges of one piece, to be cut along.
struct SurfacePath {
  int piece;
  std::vector<int> vertices;
};

/// The identity: every chart one piece, nothing divided.
CutAtlas whole_atlas(const std::vector<Chart>& charts);

/// Every divided chart one piece, vertices and triangles in the mesh's order; where it was opened the openings are seams.
/// `space_points` tells for every vertex of every chart which point in space it is: vertices that divide a boundary edge at the
/// same place in space are one point.
CutAtlas divided_atlas(const std::vector<SplitMesh>& meshes, const std::vector<Chart>& sources,
                       const std::vector<std::vector<int>>& space_points);

/// Takes pieces apart along the paths. `sources` are the charts of the input.
CutAtlas cut_along(const CutAtlas& atlas, const std::vector<Chart>& sources, std::span<const SurfacePath> paths);

/// True where nothing of the chart is divided or cut open in a piece that has all of it.
bool is_whole(const Piece& piece, const Chart& chart);

/// A piece that can be divided and cut.
SplitMesh mesh_of(const Piece& piece);

/// For every vertex of every piece a number for the point in space where it lies, as `space_points` has for those of the charts;
/// vertices that are new have one each of their own.
std::vector<std::vector<int>> points_in_space(const CutAtlas& atlas, const std::vector<std::vector<int>>& space_points);

std::vector<Chart> meshes_of(const CutAtlas& atlas);
std::vector<int> charts_of(const CutAtlas& atlas);  ///< of each piece
std::vector<std::vector<Vec2>> uvs_of(const std::vector<Chart>& charts);
/// The atlas with other UVs, one array per piece.
CutAtlas with_uvs(CutAtlas atlas, const std::vector<std::vector<Vec2>>& uvs);

}  // namespace atlas_refine
