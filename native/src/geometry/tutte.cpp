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

/// Undirected edges of the chart with its inner loops filled, each once per adjacent triangle: interior edges count twice.
std::vector<std::pair<int, int>> filled_edges(const Chart& chart, std::size_t outer) {
  std::vector<std::pair<int, int>> edges;
  for (const Triangle& t : chart.triangles) {
    for (int k = 0; k < 3; ++k) edges.emplace_back(t[k], t[(k + 1) % 3]);
  }
  int hidden = chart.vertex_count();
  for (std::size_t l = 0; l < chart.boundary_loops.size(); ++l) {
    if (l == outer) continue;
    for (int v : chart.boundary_loops[l]) edges.emplace_back(v, hidden);
    ++hidden;
  }
  return edges;
}

}  // namespace

std::size_t longest_loop(const Chart& chart) {
  const std::vector<double> lengths = make_boundary({chart}, {0}).loop_length;
  return std::max_element(lengths.begin(), lengths.end()) - lengths.begin();
}

std::vector<Vec2> tutte_disk(const Chart& chart) {
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
  return tutte(chart, outer, circle);
}

std::vector<Vec2> tutte(const Chart& chart, std::size_t outer, const std::vector<Vec2>& polygon) {
  const int count = chart.vertex_count() + static_cast<int>(chart.boundary_loops.size()) - 1;
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
  for (const auto& [i, j] : filled_edges(chart, outer)) {
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

}  // namespace atlas_refine
