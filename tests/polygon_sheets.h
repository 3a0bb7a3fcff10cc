// Sheets of square cells joined to polygons, and a cube unfolded: meshes whose edges are few.
#pragma once

#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "small_atlases.h"

namespace atlas_refine::testing {

using Cell = std::pair<int, int>;

/// The cells of a rectilinear sheet, `wanted` of all with 0 <= x, y < size.
inline std::vector<Cell> cells_where(int size, const std::function<bool(int, int)>& wanted) {
  std::vector<Cell> out;
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      if (wanted(x, y)) out.emplace_back(x, y);
    }
  }
  return out;
}

/// An L of two legs, each a third as wide as long.
inline std::vector<Cell> l_cells(int third) {
  return cells_where(3 * third, [=](int x, int y) { return x < third || y < third; });
}

/// Numbers vertices of the grid as they are met; positions are bent into a gentle wave, UVs turned off the axes.
class SheetBuilder {
 public:
  int vertex(int x, int y) {
    const auto [at, added] = index_.try_emplace({x, y}, static_cast<int>(positions_.size()));
    if (added) positions_.push_back({static_cast<double>(x), static_cast<double>(y), 0.4 * std::sin(0.3 * x + 0.2 * y)});
    return at->second;
  }
  Atlas atlas(const std::vector<std::vector<int>>& faces) const {
    Atlas out = flat_atlas(positions_, faces);
    const double c = std::cos(0.3), s = std::sin(0.3);
    for (Vec2& uv : out.corner_uvs) uv = Vec2(c * uv.x() - s * uv.y(), s * uv.x() + c * uv.y());
    return out;
  }

 private:
  std::map<Cell, int> index_;
  std::vector<Vec3> positions_;
};

/// One quad a cell.
inline Atlas quads(const std::vector<Cell>& cells) {
  SheetBuilder sheet;
  std::vector<std::vector<int>> faces;
  for (const auto& [x, y] : cells)
    faces.push_back({sheet.vertex(x, y), sheet.vertex(x + 1, y), sheet.vertex(x + 1, y + 1), sheet.vertex(x, y + 1)});
  return sheet.atlas(faces);
}

/// Bricks: hexagons of two cells, every other row half a brick further; cells that have no neighbour stay quads.
inline Atlas bricks(const std::vector<Cell>& cells) {
  SheetBuilder sheet;
  std::map<Cell, bool> used;
  for (const Cell& cell : cells) used[cell] = false;
  std::vector<std::vector<int>> faces;
  for (const auto& [x, y] : cells) {
    if (used[{x, y}]) continue;
    used[{x, y}] = true;
    const auto beside = used.find({x + 1, y});
    const bool joined = (x + y) % 2 == 0 && beside != used.end() && !beside->second;
    if (joined) beside->second = true;
    std::vector<int> face;
    const int end = joined ? x + 2 : x + 1;
    for (int i = x; i <= end; ++i) face.push_back(sheet.vertex(i, y));
    for (int i = end; i >= x; --i) face.push_back(sheet.vertex(i, y + 1));
    faces.push_back(std::move(face));
  }
  return sheet.atlas(faces);
}

/// A cube of six quads, unfolded to a cross: one chart.
inline Atlas cube_cross() {
  Atlas cube = flat_atlas({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}},
                          {{4, 5, 6, 7}, {5, 1, 2, 6}, {7, 6, 2, 3}, {0, 4, 7, 3}, {0, 1, 5, 4}, {1, 0, 3, 2}});
  const std::vector<std::vector<Vec2>> uvs = {{{1, 1}, {2, 1}, {2, 2}, {1, 2}}, {{2, 1}, {3, 1}, {3, 2}, {2, 2}},
                                              {{1, 2}, {2, 2}, {2, 3}, {1, 3}}, {{0, 1}, {1, 1}, {1, 2}, {0, 2}},
                                              {{1, 0}, {2, 0}, {2, 1}, {1, 1}}, {{3, 1}, {4, 1}, {4, 2}, {3, 2}}};
  cube.corner_uvs.clear();
  for (const auto& face : uvs) cube.corner_uvs.insert(cube.corner_uvs.end(), face.begin(), face.end());
  return cube;
}

}  // namespace atlas_refine::testing
