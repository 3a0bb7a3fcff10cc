// UVs of the input found by what the vertices stand for; losses summed up in cells.
#include "needed/cut_shapes.h"

#include <algorithm>
#include <cmath>

#include "geometry/guards.h"
#include "measure/bad_triangles.h"
#include "measure/certificate.h"
#include "measure/distortion.h"

namespace atlas_refine {
namespace {

constexpr int kCells = 24;  // along a chart: losses are told so finely

/// What a chart has lost on its way from `before`, divided by `area`; of triangles that had a shape.
std::vector<Loss> bent(const Chart& before, const Chart& after, double area) {
  const Box box = box_of_points(after.uvs);
  std::vector<Loss> cells(kCells * kCells, {Vec2::Zero(), 0});
  std::vector<double> areas(cells.size(), 0);
  const std::vector<double> lost_before = triangle_losses(before, dirichlet_sums(before).best_scale());
  const std::vector<double> lost_after = triangle_losses(after, dirichlet_sums(after).best_scale());
  for (std::size_t t = 0; t < after.triangles.size(); ++t) {
    const auto [a, b, c] = after.triangles[t];
    const Vec2 middle = (after.uvs[a] + after.uvs[b] + after.uvs[c]) / 3;
    const Vec2 place = (middle - box.min).cwiseQuotient(box.size()) * kCells;
    const int column = std::min(kCells - 1, static_cast<int>(place.x())), row = std::min(kCells - 1, static_cast<int>(place.y()));
    const double lost = lost_after[t] - lost_before[t], own = after.surface[t].area;
    if (!std::isfinite(lost)) continue;
    Loss& cell = cells[row * kCells + column];
    areas[row * kCells + column] += own;
    cell.at += own * middle;
    cell.amount += lost / area;
  }
  std::vector<Loss> out;
  for (std::size_t k = 0; k < cells.size(); ++k) {
    if (areas[k] > 0) out.push_back({cells[k].at / areas[k], cells[k].amount});
  }
  return out;
}

}  // namespace

ShapesAsTheyCame shapes_as_they_came(const std::vector<Chart>& charts, const CutAtlas& whole, const std::vector<int>& mended) {
  double area = 0;
  for (const Chart& chart : charts) area += chart.surface.area();
  ShapesAsTheyCame out{.uvs = std::vector<std::vector<Vec2>>(charts.size()),
                       .bent = std::vector<std::vector<Loss>>(charts.size())};
  for (const int c : mended) {
    if (!is_whole(whole.pieces[c], charts[c]) || !(sums_of_good(charts[c]).best_energy() < kLine)) continue;
    out.uvs[c] = charts[c].uvs;
    out.bent[c] = bent(charts[c], whole.pieces[c].mesh, area);
  }
  return out;
}

void restore_shapes(const ShapesAsTheyCame& shapes, CutAtlas& atlas) {
  for (Piece& piece : atlas.pieces) {
    const std::vector<Vec2>& uvs = shapes.uvs[piece.chart];
    if (uvs.empty()) continue;
    Chart mesh = piece.mesh;
    for (int v = 0; v < mesh.vertex_count(); ++v) mesh.uvs[v] = value_at(piece.supports[v], uvs);
    drop_broken_guards(mesh);
    if (mesh.guards.size() == piece.mesh.guards.size() && certify_charts({mesh}).valid()) piece.mesh = std::move(mesh);
  }
}

}  // namespace atlas_refine
