// Pieces that only move and pieces that hang on the box: the engine's derivatives by finite differences, and against the same
// system where every vertex is free.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <numeric>
#include <ostream>

#include "charts.h"
#include "dense_matrix.h"
#include "finite_differences.h"
#include "reduce/contact_set.h"
#include "reduce/model.h"
#include "shapes.h"
#include "support/rng.h"

namespace atlas_refine {
namespace {

using testing::charts_of;
using testing::expect_close;
using testing::numeric_gradient;
using testing::numeric_hessian;

constexpr double kStep = 1e-8;
constexpr double kStiffness = 1e-3;

/// Four squares around a cross of gaps, all within the barrier's reach of each other.
std::vector<Chart> four_squares() {
  const auto square = [](double x, double y, double turn) {
    return shapes::mesh(shapes::transformed(shapes::rectangle(0.45, 0.45), 1, turn, {x, y}), 0.3);
  };
  return charts_of(shapes::combine(
      {square(0.0015, 0.0015, 0), square(0.4557, 0.002, 0), square(0.0025, 0.4557, 0.001), square(0.4565, 0.4556, 0)}));
}

struct Rule {
  Freedoms freedom;
  double aspect;
  bool rides = false;  // with the box
};
void PrintTo(const Rule& rule, std::ostream* out) { *out << any_fixed(rule.freedom) << " fixed, aspect " << rule.aspect; }

constexpr Freedom kBends = Freedom::Bends, kMoves = Freedom::Moves, kFixed = Freedom::Fixed;

class HeldSystem : public ::testing::TestWithParam<Rule> {
 protected:
  HeldSystem() : charts_(four_squares()), model_(model_with(GetParam().freedom)), start_(model_.start) {
    // The unknowns of a state: the nodes that are not empty, then the sides of the box.
    for (int v = 0; v < model_.vertex_count(); ++v) {
      if (model_.node[v] == v) nodes_.push_back(v);
    }
    contacts_ = find_contacts(model_, start_);
  }

  ReduceModel model_with(const Freedoms& freedom) const {
    const double aspect = GetParam().aspect;
    const bool framed = any_fixed(GetParam().freedom);
    ReduceModel model = make_model({.charts = charts_,
                                    .gap = {0.002},
                                    .box_aspect = aspect,
                                    .pe_target = 0.9,
                                    .freedom = freedom,
                                    .frame = framed ? Vec2(aspect * 0.9068, 0.9068) : Vec2(Vec2::Zero())});
    if (GetParam().rides) ride_along(model.start, model);
    return model;
  }
  int sides() const { return GetParam().aspect == 0 ? 2 : 1; }
  int count() const { return 2 * static_cast<int>(nodes_.size()) + sides(); }

  /// The step of all nodes that the unknowns stand for.
  std::vector<Vec2> step(const Eigen::VectorXd& unknowns) const {
    std::vector<Vec2> out(model_.node_count(), Vec2::Zero());
    for (std::size_t k = 0; k < nodes_.size(); ++k) out[nodes_[k]] = unknowns.segment<2>(2 * static_cast<Eigen::Index>(k));
    out.back().head(sides()) = unknowns.tail(sides());
    spread(model_, out);
    return out;
  }
  ReduceState state(const Eigen::VectorXd& unknowns) const { return moved(model_, start_, step(unknowns), {{1, 1, 1, 1}}, 1); }
  Eigen::VectorXd stacked(const std::vector<Vec2>& nodes) const {
    Eigen::VectorXd out(count());
    for (std::size_t k = 0; k < nodes_.size(); ++k) out.segment<2>(2 * static_cast<Eigen::Index>(k)) = nodes[nodes_[k]];
    out.tail(sides()) = nodes.back().head(sides());
    return out;
  }

  enum Parts { Contacts = 1, Walls = 2, Energy = 4, All = 7 };
  static void assemble(const ReduceModel& model, const ReduceState& at, const ContactSet& contacts, int parts,
                       BlockSystem& system) {
    auto pairs = triangle_sides(model.triangles);
    const auto coupled = coupled_nodes(model, at, contacts);
    pairs.insert(pairs.end(), coupled.begin(), coupled.end());
    system.matrix.analyse(model.node_count(), pairs, model.box_node());
    ASSERT_TRUE(covers(system.matrix, model, contacts));
    system.set_zero();
    if (parts & Energy)
      add_dirichlet(model.objective, model.triangles, triangle_slots(system.matrix, model.triangles), at.x, 1, system);
    if (parts & Contacts) add_contacts(model, at, contacts, kStiffness, system);
    if (parts & Walls) add_walls(model, at, kStiffness, system);
  }
  /// Rows and columns of the unknowns.
  Eigen::MatrixXd of_unknowns(const Eigen::MatrixXd& matrix) const {
    Eigen::MatrixXd columns(matrix.rows(), count()), out(count(), count());
    const auto index = [&](int k) {
      const int nodes = static_cast<int>(nodes_.size());
      return k < 2 * nodes ? 2 * nodes_[k / 2] + k % 2 : 2 * model_.box_node() + k - 2 * nodes;
    };
    for (int k = 0; k < count(); ++k) columns.col(k) = matrix.col(index(k));
    for (int k = 0; k < count(); ++k) out.row(k) = columns.row(index(k));
    return out;
  }

  std::vector<Chart> charts_;
  ReduceModel model_;
  ReduceState start_;
  std::vector<int> nodes_;
  ContactSet contacts_;
};

TEST_P(HeldSystem, PiecesKeepTheirShapeOrTheirPlaceInTheBox) {
  Rng rng(3);
  Eigen::VectorXd unknowns(count());
  for (double& u : unknowns) u = rng.uniform(-0.01, 0.01);
  const ReduceState after = state(unknowns);
  for (std::size_t p = 0; p < charts_.size(); ++p) {
    for (int v = model_.first_vertex[p]; v < model_.first_vertex[p + 1]; ++v) {
      const int first = model_.first_vertex[p];
      const Vec2 now = after.x[v] - after.x[first], before = start_.x[v] - start_.x[first];
      if (GetParam().freedom[p] == kMoves) {
        EXPECT_NEAR((now - before).norm(), 0, 1e-15);
      }
      if (GetParam().freedom[p] == kFixed) {
        EXPECT_NEAR((after.x[v].cwiseQuotient(after.box) - start_.x[v].cwiseQuotient(start_.box)).norm(), 0, 1e-15);
      }
    }
  }
}

TEST_P(HeldSystem, HasContactsOfEveryKindAndNoneWithinHeldPieces) {
  ASSERT_GT(contacts_.size(), 8u);
  for (const Contact& contact : contacts_) EXPECT_FALSE(moves_as_one(model_, contact.pair));
  EXPECT_TRUE(std::isfinite(barrier(model_, start_, contacts_)));
  EXPECT_GT(barrier(model_, start_, contacts_), 0);
}

TEST_P(HeldSystem, GradientOfEnergyAndBarrier) {
  BlockSystem system;
  assemble(model_, start_, contacts_, All, system);
  const auto energy = [&](const Eigen::VectorXd& unknowns) {
    const ReduceState at = state(unknowns);
    return model_energy(model_, at.x) + kStiffness * barrier(model_, at, contacts_);
  };
  expect_close(stacked(system.gradient), numeric_gradient(energy, Eigen::VectorXd::Zero(count()), kStep), 2e-5);
}

TEST_P(HeldSystem, GradientOfLogPe) {
  const auto log_pe = [&](const Eigen::VectorXd& unknowns) { return std::log(box_pe(model_, state(unknowns))); };
  expect_close(stacked(pe_gradient(model_, start_)), numeric_gradient(log_pe, Eigen::VectorXd::Zero(count()), 1e-6), 1e-7);
}

TEST_P(HeldSystem, HessianOfTheWallsIsExact) {
  const auto gradient = [&](const Eigen::VectorXd& unknowns) {
    BlockSystem system;
    assemble(model_, state(unknowns), contacts_, Walls, system);
    return stacked(system.gradient);
  };
  BlockSystem system;
  assemble(model_, start_, contacts_, Walls, system);
  const Eigen::MatrixXd numeric = numeric_hessian(gradient, Eigen::VectorXd::Zero(count()), kStep);
  ASSERT_GT(numeric.norm(), 0);
  expect_close(of_unknowns(testing::dense(system)), numeric, 1e-4);
}

TEST_P(HeldSystem, ContactsAreThoseOfFreeVerticesSeenFromTheNodes) {
  ReduceModel free = model_with({});
  free.ride.clear();
  BlockSystem held, vertices;
  assemble(model_, start_, contacts_, Contacts, held);
  assemble(free, start_, contacts_, Contacts, vertices);
  Eigen::MatrixXd moves(2 * model_.node_count(), count());
  for (int k = 0; k < count(); ++k) {
    const std::vector<Vec2> nodes = step(Eigen::VectorXd::Unit(count(), k));
    for (int n = 0; n < model_.node_count(); ++n) moves.col(k).segment<2>(2 * n) = nodes[n];
  }
  expect_close(of_unknowns(testing::dense(held)), moves.transpose() * testing::dense(vertices) * moves, 1e-12);
}

TEST_P(HeldSystem, ProjectedMatrixIsPositiveSemidefinite) {
  BlockSystem system;
  assemble(model_, start_, contacts_, All, system);
  const Eigen::VectorXd spectrum = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(testing::dense(system)).eigenvalues();
  EXPECT_GE(spectrum.minCoeff(), -1e-10 * spectrum.maxCoeff());
}

INSTANTIATE_TEST_SUITE_P(KindsOfPieces, HeldSystem,
                         ::testing::Values(Rule{{kBends, kMoves, kBends, kMoves}, 0}, Rule{{kMoves, kMoves, kMoves, kMoves}, 0},
                                           Rule{{kMoves, kBends, kBends, kMoves}, 1}, Rule{{kFixed, kBends, kBends, kMoves}, 1},
                                           Rule{{kBends, kMoves, kFixed, kFixed}, 1.02},
                                           Rule{{kFixed, kFixed, kMoves, kMoves}, 1},
                                           Rule{{kBends, kBends, kFixed, kBends}, 1.03}));
INSTANTIATE_TEST_SUITE_P(RidingWithTheBox, HeldSystem,
                         ::testing::Values(Rule{{kBends, kBends, kBends, kBends}, 0, true},
                                           Rule{{kBends, kMoves, kBends, kMoves}, 0, true},
                                           Rule{{kMoves, kBends, kBends, kBends}, 1, true},
                                           Rule{{kFixed, kBends, kBends, kMoves}, 1, true},
                                           Rule{{kBends, kBends, kFixed, kBends}, 1.03, true}));

TEST(RidingModel, TheBoxTakesChartsAlongAsTheyAre) {
  const std::vector<Chart> charts = four_squares();
  for (const double aspect : {0.0, 1.0}) {
    ReduceModel model = make_model({.charts = charts, .box_aspect = aspect, .pe_target = 0.9});
    ride_along(model.start, model);
    std::vector<Vec2> step(model.node_count(), Vec2::Zero());
    step.back() = aspect == 0 ? Vec2(-0.02, -0.01) : Vec2(-0.02, 0);
    spread(model, step);
    const ReduceState after = moved(model, model.start, step, {{1, 1, 1, 1}}, 1);
    const auto middle = [&](const ReduceState& state, std::size_t p) {
      const auto begin = state.x.begin() + model.first_vertex[p], end = state.x.begin() + model.first_vertex[p + 1];
      return Vec2(std::accumulate(begin, end, Vec2(Vec2::Zero())) / static_cast<double>(end - begin));
    };
    ASSERT_LT(after.box.x(), model.start.box.x());
    for (std::size_t p = 0; p < charts.size(); ++p) {
      const Vec2 before = middle(model.start, p).cwiseQuotient(model.start.box);
      EXPECT_NEAR((middle(after, p).cwiseQuotient(after.box) - before).norm(), 0, 1e-14);
      for (int v = model.first_vertex[p]; v < model.first_vertex[p + 1]; ++v)
        EXPECT_NEAR((after.x[v] - middle(after, p) - model.start.x[v] + middle(model.start, p)).norm(), 0, 1e-14);
    }
  }
}

TEST(HeldModel, WhatIsFixedCountsInPeAndNotInTheObjective) {
  const std::vector<Chart> charts = four_squares();
  const ReduceModel model = make_model(
      {.charts = charts, .box_aspect = 1, .pe_target = 0.9, .freedom = {kFixed, kMoves, kBends, kBends}, .frame = {0.92, 0.92}});
  EXPECT_NEAR(box_pe(model, model.start), uv_area(charts) / (0.92 * 0.92), 1e-12);
  EXPECT_NEAR(model_energy(model, model.start.x), testing::energy_as_is({charts[1], charts[2], charts[3]}), 1e-12);
  EXPECT_NEAR(surface_distortion(charts, model, model.start.x), dirichlet_sums(charts).best_energy(), 1e-12);
}

TEST(HeldModel, OnlyTheInsideOfTheBoxCountsOfAFixedChart) {
  std::vector<Chart> charts = four_squares();
  for (Vec2& uv : charts[0].uvs) uv.x() -= 0.2265;  // half of its width, and what it was from the wall
  const ReduceModel model = make_model(
      {.charts = charts, .box_aspect = 1, .pe_target = 0.9, .freedom = {kFixed, kBends, kBends, kBends}, .frame = {0.92, 0.92}});
  EXPECT_NEAR(model.fixed_share * 0.92 * 0.92, 0.5 * 0.45 * 0.45, 1e-12);
}

TEST(HeldReduction, ClimbsToTheTargetWithoutBendingWhatIsHeld) {
  std::vector<Chart> charts = four_squares();
  const Freedoms freedom = {kFixed, kMoves, kBends, kBends};
  const auto problem = [&](double target) {
    return ReduceProblem{
        .charts = charts, .gap = {0.002}, .box_aspect = 1, .pe_target = target, .freedom = freedom, .frame = {1, 1}};
  };
  const ReduceResult result = reduce_distortion(problem(0.95));
  ASSERT_TRUE(result.reached);
  const std::vector<Chart> after = testing::with_uvs(charts, result.uvs);
  testing::expect_certified(after);
  EXPECT_GE(gap_between_charts(after), 0.002 * result.frame.norm() * (1 - 1e-12));
  EXPECT_NEAR(uv_area(after) / result.frame.prod(), result.pe, 1e-12);
  EXPECT_GE(result.pe, 0.95);
  for (std::size_t v = 0; v < charts[0].uvs.size(); ++v)
    EXPECT_NEAR((result.uvs[0][v] / result.frame.y() - charts[0].uvs[v]).norm(), 0, 1e-14);
  for (std::size_t v = 0; v < charts[1].uvs.size(); ++v)
    EXPECT_NEAR((result.uvs[1][v] - result.uvs[1][0] - charts[1].uvs[v] + charts[1].uvs[0]).norm(), 0, 1e-12);
}

}  // namespace
}  // namespace atlas_refine
