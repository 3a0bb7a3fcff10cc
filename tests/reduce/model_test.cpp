// The engine's model, contacts and walls by finite differences: every vertex and both box sides, walls, contacts, the gap that
// follows the box.
#include "reduce/model.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <optional>
#include <ostream>

#include "charts.h"
#include "dense_matrix.h"
#include "finite_differences.h"
#include "reduce/contact_set.h"
#include "shapes.h"
#include "support/rng.h"

namespace atlas_refine {
namespace {

using testing::charts_of;
using testing::expect_close;
using testing::numeric_gradient;
using testing::numeric_hessian;

constexpr double kStep = 1e-8;  // the barrier's range is about 0.005

/// Two charts so close that the barrier is felt between them and inside the slot of the first; walls are felt from the start.
std::vector<Chart> close_charts() {
  const shapes::Polygon slotted{{{0, 0}, {1, 0}, {1, 1}, {0.5028, 1}, {0.5028, 0.5}, {0.4972, 0.5}, {0.4972, 1}, {0, 1}}, {}};
  const shapes::Polygon neighbour = shapes::transformed(shapes::rectangle(0.6, 0.9), 1, 0, {1.0066, 0.05});
  return charts_of(shapes::combine({shapes::mesh(slotted, 0.25), shapes::mesh(neighbour, 0.3)}));
}

struct Rule {
  double aspect;
  Gap gap;
};
void PrintTo(const Rule& rule, std::ostream* out) { *out << "aspect " << rule.aspect << ", gap " << rule.gap.value; }

/// All unknowns in one array: vertices, then width and height, or the height alone where the aspect is fixed.
class WholeSystem : public ::testing::TestWithParam<Rule> {
 protected:
  explicit WholeSystem(std::vector<Chart> charts = close_charts())
      : charts_(std::move(charts)),
        model_(make_model({.charts = charts_, .gap = GetParam().gap, .box_aspect = GetParam().aspect, .pe_target = 0.9})),
        start_(model_.start) {
    Rng rng(8);
    for (Vec2& x : start_.x) {
      x.x() += rng.uniform(-1, 1) * 0.05 * model_.range;
      x.y() += rng.uniform(-1, 1) * 0.05 * model_.range;
    }
    contacts_ = find_contacts(model_, start_);
  }

  int sides() const { return GetParam().aspect == 0 ? 2 : 1; }

  Eigen::VectorXd stacked(const std::vector<Vec2>& nodes) const {
    Eigen::VectorXd all(2 * model_.vertex_count() + sides());
    for (int v = 0; v < model_.vertex_count(); ++v) all.segment<2>(2 * v) = nodes[v];
    all.tail(sides()) = nodes[model_.vertex_count()].head(sides());
    return all;
  }
  Eigen::VectorXd unknowns() const {
    std::vector<Vec2> nodes = start_.x;
    nodes.push_back(GetParam().aspect == 0 ? start_.box : Vec2(start_.box.y(), 0));
    return stacked(nodes);
  }
  ReduceState state(const Eigen::VectorXd& all) const {
    ReduceState result = start_;
    for (int v = 0; v < model_.vertex_count(); ++v) result.x[v] = all.segment<2>(2 * v);
    result.box = GetParam().aspect == 0 ? Vec2(all.tail<2>()) : Vec2(GetParam().aspect * all.tail<1>()[0], all.tail<1>()[0]);
    return result;
  }
  Eigen::VectorXd energy_gradient(const Eigen::VectorXd& all) {
    assemble(state(all));
    return stacked(system_.gradient);
  }
  void assemble(const ReduceState& at) {
    auto pairs = triangle_sides(model_.triangles);
    const auto coupled = coupled_nodes(model_, at, contacts_);
    pairs.insert(pairs.end(), coupled.begin(), coupled.end());
    system_.matrix.analyse(model_.node_count(), pairs, model_.box_node());
    EXPECT_TRUE(covers(system_.matrix, model_, contacts_));
    system_.set_zero();
    add_dirichlet(model_.objective, model_.triangles, triangle_slots(system_.matrix, model_.triangles), at.x, 1, system_);
    add_contacts(model_, at, contacts_, kStiffness, system_);
    add_walls(model_, at, kStiffness, system_);
  }
  Eigen::MatrixXd assembled_matrix() {
    assemble(start_);
    return testing::dense(system_);
  }

  static constexpr double kStiffness = 1e-3;
  std::vector<Chart> charts_;
  ReduceModel model_;
  BlockSystem system_;
  ReduceState start_;
  ContactSet contacts_;
};

TEST_P(WholeSystem, HasContactsBetweenAndWithinChartsAndAtTheWalls) {
  int between = 0, within = 0, walls = 0;
  const Boundary& b = model_.boundary;
  for (const Contact& contact : contacts_) ++(b.chart[contact.pair.point] == b.chart[contact.pair.edge] ? within : between);
  for (const int v : b.vertex)
    walls += start_.x[v].minCoeff() < model_.range || (start_.box - start_.x[v]).minCoeff() < model_.range;
  EXPECT_GT(between, 3);
  EXPECT_GT(within, 3);
  EXPECT_GT(walls, 6);
  EXPECT_GT(barrier(model_, start_, contacts_), 0);
  EXPECT_TRUE(std::isfinite(barrier(model_, start_, contacts_)));
}

TEST_P(WholeSystem, GradientOfEnergyAndBarrier) {
  const auto objective = [&](const Eigen::VectorXd& all) {
    const ReduceState at = state(all);
    return dirichlet_energy(model_.objective, model_.triangles, at.x) + kStiffness * barrier(model_, at, contacts_);
  };
  expect_close(energy_gradient(unknowns()), numeric_gradient(objective, unknowns(), kStep), 2e-5);
}

TEST_P(WholeSystem, GradientOfTheBarrierAloneByTheBoxSides) {
  const auto barrier_at = [&](const Eigen::VectorXd& all) { return barrier(model_, state(all), contacts_); };
  const Eigen::VectorXd by_sides = numeric_gradient(barrier_at, unknowns(), kStep).tail(sides());
  const Eigen::VectorXd assembled = energy_gradient(unknowns()).tail(sides()) / kStiffness;  // E does not depend on the box
  expect_close(assembled, by_sides, 1e-5);
}

TEST_P(WholeSystem, GradientOfLogPe) {
  const auto log_pe = [&](const Eigen::VectorXd& all) { return std::log(box_pe(model_, state(all))); };
  expect_close(stacked(pe_gradient(model_, start_)), numeric_gradient(log_pe, unknowns(), 1e-6), 1e-8);
}

TEST_P(WholeSystem, ProjectedMatrixIsPositiveSemidefinite) {
  const Eigen::VectorXd spectrum = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(assembled_matrix()).eigenvalues();
  EXPECT_GE(spectrum.minCoeff(), -1e-10 * spectrum.maxCoeff());
  EXPECT_TRUE(factor_damped(system_, model_.masses, {1e-6, 10, 1e-6}));
}

TEST_P(WholeSystem, StepsKeepTheAspectExactly) {
  if (GetParam().aspect == 0) return;
  EXPECT_DOUBLE_EQ(start_.box.x(), GetParam().aspect * start_.box.y());
  std::vector<Vec2> step(model_.vertex_count(), Vec2::Zero());
  step.emplace_back(-0.123, 0.77);  // the second value belongs to the empty equation
  const ReduceState after = moved(model_, start_, step, {{1, 1}}, 0.5);
  EXPECT_DOUBLE_EQ(after.box.y(), start_.box.y() - 0.0615);
  EXPECT_NEAR(after.box.x(), GetParam().aspect * after.box.y(), 1e-15);
}

const auto kRules = ::testing::Values(Rule{0, {}}, Rule{0, {0.0025, Gap::Unit::LongSide}}, Rule{1, {}}, Rule{2.5, {0.002}},
                                      Rule{2.5, {0.0025, Gap::Unit::LongSide}}, Rule{0.4, {0.001, Gap::Unit::LongSide}});
INSTANTIATE_TEST_SUITE_P(FreeAndFixedAspect, WholeSystem, kRules);

/// Without contacts nothing is projected near an isometry: the matrix is the Hessian, walls and their coupling to the box
/// included.
class SystemOfOneChart : public WholeSystem {
 protected:
  SystemOfOneChart() : WholeSystem(charts_of(shapes::mesh(shapes::rectangle(1, 0.7), 0.2, 0.3))) {
    for (const Contact& contact : contacts_) EXPECT_EQ(contact.floor_fraction, 0);
    contacts_.clear();
  }
};

TEST_P(SystemOfOneChart, HessianIsExact) {
  const Eigen::MatrixXd numeric =
      numeric_hessian([&](const Eigen::VectorXd& all) { return energy_gradient(all); }, unknowns(), kStep);
  const Eigen::MatrixXd dense = assembled_matrix();
  const int count = static_cast<int>(unknowns().size());
  expect_close(dense.topLeftCorner(count, count), numeric, 1e-4);
}

INSTANTIATE_TEST_SUITE_P(FreeAndFixedAspect, SystemOfOneChart, ::testing::Values(Rule{0, {}}, Rule{1, {}}, Rule{2.5, {}}));

TEST(ReduceModel, FreeStepsNeitherFlipNorCross) {
  const std::vector<Chart> charts = close_charts();
  const ReduceModel model = make_model({.charts = charts, .pe_target = 0.9});
  Rng rng(21);
  int limited = 0;
  for (int trial = 0; trial < 50; ++trial) {
    std::vector<Vec2> step(model.vertex_count() + 1, Vec2::Zero());
    for (int v = 0; v < model.vertex_count(); ++v) step[v] = {rng.uniform(-0.2, 0.2), rng.uniform(-0.2, 0.2)};
    const StepBounds bounds = free_step(model, model.start, step);
    ASSERT_EQ(bounds.of_piece.size(), charts.size());
    EXPECT_GT(bounds.least(), 0);
    limited += bounds.least() < 1;
    const auto uvs = by_piece(model, moved(model, model.start, step, bounds, 1).x, model.objective.unit);
    testing::expect_certified(testing::with_uvs(charts, uvs));
  }
  EXPECT_GT(limited, 40);
}

TEST(ReduceModel, TheStartComesBackInItsOwnUnits) {
  const std::vector<Chart> charts = close_charts();
  const ReduceModel model = make_model({.charts = charts, .pe_target = 0.9});
  const auto uvs = by_piece(model, model.start.x, model.objective.unit);
  const Vec2 shift = uvs[0][0] - charts[0].uvs[0];
  for (std::size_t c = 0; c < charts.size(); ++c) {
    for (std::size_t v = 0; v < uvs[c].size(); ++v) EXPECT_NEAR((uvs[c][v] - shift - charts[c].uvs[v]).norm(), 0, 1e-12);
  }
  EXPECT_NEAR(tight_pe(model, model.start), testing::packing_efficiency(charts), 1e-12);
  EXPECT_NEAR(dirichlet_energy(model.objective, model.triangles, model.start.x), testing::energy_as_is(charts), 1e-12);
  EXPECT_NEAR(surface_distortion(charts, model, model.start.x), dirichlet_sums(charts).best_energy(), 1e-12);
}

TEST(ReduceModel, NeighboursAlongTheBoundaryAreContactsOnlyWhereAStepBringsThemTogether) {
  // Two thin arms; near the inner corner borders of both face each other.
  const shapes::Polygon angle{{{0, 0}, {1, 0}, {1, 0.03}, {0.03, 0.03}, {0.03, 1}, {0, 1}}, {}};
  const std::vector<Chart> charts = charts_of(shapes::mesh(angle, 0.003, 0));
  const ReduceModel model = make_model({.charts = charts, .pe_target = 0.9});
  const Boundary& b = model.boundary;
  const auto& x = model.start.x;
  const double reach = model.gap.length(model.start.box) + model.range;
  std::optional<PointEdge> facing;
  for (const PointEdge& pair : near_pairs(b, x, {}, reach)) {
    const Closest nearest = closest_on_segment(x[b.vertex[pair.point]], x[b.vertex[pair.edge]], x[b.vertex[b.next[pair.edge]]]);
    if (nearest.distance < reach && faces_outside(b, x, pair, nearest)) facing = pair;
  }
  ASSERT_TRUE(facing);
  EXPECT_TRUE(find_contacts(model, model.start).empty());
  std::vector<Vec2> step(x.size(), Vec2::Zero());
  step[b.vertex[facing->point]] = x[b.vertex[facing->edge]] - x[b.vertex[facing->point]];
  bool found = false;
  for (const Contact& contact : find_contacts(model, model.start, step))
    found = found || (contact.pair.point == facing->point && contact.pair.edge == facing->edge);
  EXPECT_TRUE(found);
}

TEST(ReduceModel, ForcesAreTheBarriersSlope) {
  const std::vector<Chart> charts = close_charts();
  const ReduceModel model = make_model({.charts = charts, .pe_target = 0.9});
  const ContactSet contacts = find_contacts(model, model.start);
  const auto forces = contact_forces(model, model.start, contacts, 1e-3);
  Vec2 sum = Vec2::Zero();
  double largest = 0;
  for (const Vec2& force : forces) {
    sum += force;
    largest = std::max(largest, force.norm());
  }
  EXPECT_GT(largest, 0);
  EXPECT_LT(sum.norm(), 1e-9 * largest);  // what is pushed pushes back
}

}  // namespace
}  // namespace atlas_refine
