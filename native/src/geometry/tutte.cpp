// Tutte's embedding into a convex polygon.
#include "geometry/tutte.h"

#include <Eigen/LU>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/boundary.h"

namespace atlas_refine {
namespace {

using Edges = std::vector<std::pair<int, int>>;

/// The edges inside polygons that have guards, as their ends in ascending order, sorted.
Edges guarded_diagonals(const Chart& chart) {
  std::vector<int> guarded;
  for (const Guard& guard : chart.guards) guarded.push_back(guard.face);
  std::vector<std::array<int, 3>> sides;  // of their triangles: face, ends
  for (std::size_t t = 0; t < chart.triangles.size(); ++t) {
    const int face = chart.triangle_faces[t];
    if (!std::binary_search(guarded.begin(), guarded.end(), face)) continue;
    for (int k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(chart.triangles[t][k], chart.triangles[t][(k + 1) % 3]);
      sides.push_back({face, low, high});
    }
  }
  std::sort(sides.begin(), sides.end());
  Edges out;
  for (std::size_t k = 1; k < sides.size(); ++k) {
    if (sides[k] == sides[k - 1]) out.emplace_back(sides[k][1], sides[k][2]);
  }
  std::sort(out.begin(), out.end());
  return out;
}

/// Undirected edges of the filled chart, without those `left_out`, each once per adjacent triangle, those of fans once: most
/// interior edges count twice.
Edges filled_edges(const Chart& chart, const Filling& filling, const Edges& left_out) {
  Edges edges;
  for (const auto* triangles : {&chart.triangles, &filling.triangles}) {
    for (const Triangle& t : *triangles) {
      for (int k = 0; k < 3; ++k) {
        const int from = t[k], to = t[(k + 1) % 3];
        const std::pair<int, int> edge = std::minmax(from, to);
        if (!std::binary_search(left_out.begin(), left_out.end(), edge)) edges.emplace_back(from, to);
      }
    }
  }
  int hidden = chart.vertex_count();
  for (const std::size_t l : filling.fans) {
    for (int v : chart.boundary_loops[l]) edges.emplace_back(v, hidden);
    ++hidden;
  }
  return edges;
}

/// Every vertex at the mean of its neighbours, loop `outer` on the polygon.
std::vector<Vec2> at_means(const Chart& chart, std::size_t outer, const std::vector<Vec2>& polygon, const Filling& filling,
                           const Edges& left_out) {
  const Edges edges = filled_edges(chart, filling, left_out);
  const int count = chart.vertex_count() + static_cast<int>(filling.fans.size());
  std::vector<Vec2> uvs(count, Vec2::Zero());
  std::vector<char> fixed(count, 0);
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    uvs[chart.boundary_loops[outer][k]] = polygon[k];
    fixed[chart.boundary_loops[outer][k]] = 1;
  }

  std::vector<int> unknown(count, -1);
  int unknowns = 0;
  for (int v = 0; v < count; ++v) {
    if (!fixed[v]) unknown[v] = unknowns++;
  }
  std::vector<Eigen::Triplet<double>> triplets;
  Eigen::MatrixX2d right = Eigen::MatrixX2d::Zero(unknowns, 2);
  const auto add = [&](int from, int to) {
    if (fixed[from]) return;
    triplets.emplace_back(unknown[from], unknown[from], 1.0);
    if (fixed[to])
      right.row(unknown[from]) += uvs[to].transpose();
    else
      triplets.emplace_back(unknown[from], unknown[to], -1.0);
  };
  for (const auto& [i, j] : edges) {
    add(i, j);
    add(j, i);
  }
  Eigen::SparseMatrix<double> laplacian(unknowns, unknowns);
  laplacian.setFromTriplets(triplets.begin(), triplets.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(laplacian);
  const Eigen::MatrixX2d solution = solver.solve(right);
  for (int v = 0; v < count; ++v) {
    if (!fixed[v]) uvs[v] = solution.row(unknown[v]).transpose();
  }
  uvs.resize(chart.vertex_count());
  return uvs;
}

}  // namespace

std::size_t longest_loop(const Chart& chart) {
  const std::vector<double> lengths = make_boundary({chart}, {0}).loop_length;
  return std::max_element(lengths.begin(), lengths.end()) - lengths.begin();
}

std::vector<Vec2> tutte_disk(const Chart& chart, const Filling& filling) {
  constexpr double kLeastEdge = 0.25;  // of the mean edge: on the circle triangles with two short boundary edges would vanish
  const Boundary boundary = make_boundary({chart}, {0});
  const std::size_t outer = longest_loop(chart);
  const double length = boundary.loop_length[outer];
  const double least = kLeastEdge * length / static_cast<double>(chart.boundary_loops[outer].size());
  const double radius = std::sqrt(chart.surface.area() / std::numbers::pi);
  std::vector<Vec2> circle;
  for (int b = 0; b < boundary.size(); ++b) {
    if (boundary.loop[b] != static_cast<int>(outer)) continue;
    const double part = boundary.arc[b] + least * static_cast<double>(circle.size());
    const double angle = 2 * std::numbers::pi * part / ((1 + kLeastEdge) * length);
    circle.push_back(radius * Vec2(std::cos(angle), std::sin(angle)));
  }
  return at_means(chart, outer, circle, filling, guarded_diagonals(chart));
}

std::vector<Vec2> tutte(const Chart& chart, std::size_t outer, const std::vector<Vec2>& polygon) {
  return at_means(chart, outer, polygon, fill_by_fans(chart, outer), {});
}

}  // namespace atlas_refine
