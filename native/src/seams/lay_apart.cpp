// Places found by the triangle that each was part of; pieces shrunk about their middles.
#include "seams/lay_apart.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>

#include "geometry/plane.h"

namespace atlas_refine {
namespace {

/// A triangle of the present atlas, and its corners' weights on the chart's triangle, one a column.
struct Part {
  int piece, triangle;
  Eigen::Matrix3d weights;
};

Vec3 weights_of(const Piece& piece, int vertex, const Chart& chart, int source) {
  return weights_on(piece.supports[vertex], chart.triangles[source]);
}

class Places {
 public:
  Places(const CutAtlas& present, const std::vector<Chart>& charts) : present_(present), charts_(charts) {
    for (int p = 0; p < static_cast<int>(present.pieces.size()); ++p) {
      const Piece& piece = present.pieces[p];
      for (int t = 0; t < static_cast<int>(piece.mesh.triangles.size()); ++t) {
        Part part{p, t, {}};
        for (int k = 0; k < 3; ++k)
          part.weights.col(k) = weights_of(piece, piece.mesh.triangles[t][k], charts[piece.chart], piece.sources[t]);
        parts_[{piece.chart, piece.sources[t]}].push_back(part);
      }
    }
  }

  /// Sets the UVs of the triangle's corners; returns the piece of the present atlas that it is part of.
  int lay(Piece& piece, int triangle) const {
    const Chart& chart = charts_[piece.chart];
    const int source = piece.sources[triangle];
    const Triangle& corners = piece.mesh.triangles[triangle];
    Eigen::Matrix3d weights;
    for (int k = 0; k < 3; ++k) weights.col(k) = weights_of(piece, corners[k], chart, source);
    const Part& part = around(parts_.at({piece.chart, source}), weights.rowwise().mean());
    const Chart& mesh = present_.pieces[part.piece].mesh;
    const Eigen::Matrix3d own = part.weights.inverse() * weights;
    for (int k = 0; k < 3; ++k) {
      Vec2 uv = Vec2::Zero();
      for (int i = 0; i < 3; ++i) uv += own(i, k) * mesh.uvs[mesh.triangles[part.triangle][i]];
      piece.mesh.uvs[corners[k]] = uv;
    }
    return part.piece;
  }

 private:
  /// The part that holds a point: whose least weight there is largest.
  static const Part& around(const std::vector<Part>& parts, const Vec3& point) {
    const Part* best = &parts.front();
    double least = -INFINITY;
    for (const Part& part : parts) {
      const double own = (part.weights.inverse() * point).minCoeff();
      if (own <= least) continue;
      least = own;
      best = &part;
    }
    return *best;
  }

  const CutAtlas& present_;
  const std::vector<Chart>& charts_;
  std::map<std::pair<int, int>, std::vector<Part>> parts_;  // by chart and its triangle
};

/// Middle of the area.
Vec2 middle_of(const Chart& chart) {
  Vec2 sum = Vec2::Zero();
  double area = 0;
  for (const Triangle& t : chart.triangles) {
    const double own = doubled_area(chart.uvs[t[0]], chart.uvs[t[1]], chart.uvs[t[2]]);
    sum += own / 3 * (chart.uvs[t[0]] + chart.uvs[t[1]] + chart.uvs[t[2]]);
    area += own;
  }
  return sum / area;
}

}  // namespace

CutAtlas lay_apart(const CutAtlas& finer, const CutAtlas& present, const std::vector<Chart>& charts, double gap) {
  const Places places(present, charts);
  CutAtlas out = finer;
  out.frame = present.frame;
  std::map<int, std::vector<int>> siblings;  // by the piece that they were
  for (int p = 0; p < static_cast<int>(out.pieces.size()); ++p) {
    int from = 0;
    for (int t = 0; t < static_cast<int>(out.pieces[p].mesh.triangles.size()); ++t) from = places.lay(out.pieces[p], t);
    siblings[from].push_back(p);
  }
  for (const auto& [from, own] : siblings) {
    if (own.size() < 2) continue;
    std::vector<Vec2> middles;
    for (const int p : own) middles.push_back(middle_of(out.pieces[p].mesh));
    double nearest = INFINITY;
    for (std::size_t a = 0; a < own.size(); ++a) {
      for (std::size_t b = 0; b < a; ++b) nearest = std::min(nearest, (middles[a] - middles[b]).norm());
    }
    // Shrunk about their middles two pieces part by that share of the middles' distance.
    constexpr double kLeastKept = 0.8;
    const double kept = std::max(kLeastKept, 1 - gap / nearest);
    for (std::size_t k = 0; k < own.size(); ++k) {
      for (Vec2& uv : out.pieces[own[k]].mesh.uvs) uv = middles[k] + kept * (uv - middles[k]);
    }
  }
  return out;
}

}  // namespace atlas_refine
