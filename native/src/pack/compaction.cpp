// Sequential linear programming: the distances of near vertices and edges,
// linearised in all charts' motions.
#include "pack/compaction.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "measure/distortion.h"
#include "pack/linear_program.h"
#include "pack/near_vertices.h"
#include "pack/scene.h"
#include "pack/turns.h"

namespace atlas_refine {
namespace {

/// Variables: for each chart dx, dy and its turn times its radius; then the
/// growth of width and height (or of width alone).
class Program {
 public:
  Program(const Scene& scene, const BoxTree& tree, const CompactionOptions& options, double gap, double step, bool turning)
      : scene_(scene),
        tree_(tree),
        options_(options),
        gap_(gap),
        step_(step),
        turning_(turning),
        n_(static_cast<int>(scene.centres.size())) {}

  /// The motions, empty where the program cannot be solved.
  Eigen::VectorXd solve() {
    add_walls();
    add_contacts();
    const bool fixed = options_.box_aspect > 0;
    const int count = 3 * n_ + (fixed ? 1 : 2);
    Eigen::VectorXd cost = Eigen::VectorXd::Zero(count), reach = Eigen::VectorXd::Constant(count, step_);
    cost[3 * n_] = 1 / size_.x();
    if (!fixed) cost[3 * n_ + 1] = 1 / size_.y();
    for (int c = 0; c < n_; ++c) reach[3 * c + 2] = turning_ && scene_.turnable[c] ? 0.5 * step_ : 1e-9 * step_;
    return solve_linear_program(cost, inequalities_, reach, options_.poll);
  }

 private:
  using Term = LinearInequality::Term;

  /// Adds the terms of direction . (motion of a chart's point).
  void add_motion(LinearInequality& row, int chart, const Vec2& point, const Vec2& direction) const {
    const Vec2 arm = point - scene_.centres[chart];
    row.terms.reserve(7);
    row.terms.push_back({3 * chart, direction.x()});
    row.terms.push_back({3 * chart + 1, direction.y()});
    row.terms.push_back({3 * chart + 2, (direction.y() * arm.x() - direction.x() * arm.y()) / scene_.radii[chart]});
  }

  void add_walls() {
    const double aspect = options_.box_aspect;
    size_ = box_of_aspect(scene_.box, aspect).size();
    const Vec2 top = scene_.box.min + size_;
    for (const PlacedEdge& edge : scene_.edges) {
      for (int axis = 0; axis < 2; ++axis) {
        const Vec2 direction = Vec2::Unit(axis);
        const double low = edge.a[axis] - scene_.box.min[axis], high = top[axis] - edge.a[axis];
        if (low < 2 * step_) {
          auto& row = inequalities_.emplace_back();
          add_motion(row, edge.chart, edge.a, direction);
          row.bound = -low;
        }
        if (high < 3 * step_) {
          auto& row = inequalities_.emplace_back();
          add_motion(row, edge.chart, edge.a, -direction);
          if (aspect > 0) {
            row.terms.push_back({3 * n_, axis == 0 ? 1 : 1 / aspect});
          } else {
            row.terms.push_back({3 * n_ + axis, 1});
          }
          row.bound = -high;
        }
      }
    }
  }

  void add_contacts() {
    constexpr double kOfStep = 0.5;
    for (const NearVertex& near :
         near_vertices(scene_, tree_, gap_ + 4 * step_, turning_ ? kOfStep * step_ : 0, !turning_, options_.poll)) {
      const Vec2 normal = near.normal(scene_);
      auto& row = inequalities_.emplace_back();
      add_motion(row, scene_.edges[near.vertex].chart, scene_.edges[near.vertex].a, normal);
      add_motion(row, scene_.edges[near.edge].chart, near.foot, -normal);
      row.bound = gap_ - near.distance;
    }
  }

  const Scene& scene_;
  const BoxTree& tree_;
  const CompactionOptions& options_;
  double gap_, step_;
  bool turning_;
  int n_;
  Vec2 size_ = Vec2::Zero();
  std::vector<LinearInequality> inequalities_;
};

std::vector<Placement> moved(const std::vector<Placement>& placements, const Scene& scene, const Eigen::VectorXd& motion,
                             bool turning) {
  std::vector<Placement> result = placements;
  for (size_t c = 0; c < placements.size(); ++c) {
    if (!scene.turnable[c]) {
      result[c].offset += Vec2(motion[3 * c], motion[3 * c + 1]);
      continue;
    }
    const double angle = turning ? motion[3 * c + 2] / scene.radii[c] : 0;
    const Placement& old = placements[c];
    const Turn about{std::cos(angle), std::sin(angle)}, both = about.after({old.cosine, old.sine});
    const double length = std::hypot(both.cosine, both.sine);
    result[c] = {both.cosine / length, both.sine / length,
                 about.apply(old.offset - scene.centres[c]) + scene.centres[c] + Vec2(motion[3 * c], motion[3 * c + 1])};
  }
  return result;
}

/// Log of the area of the box that the asked aspect needs.
double box_cost(const Box& box, double aspect) { return std::log(box_of_aspect(box, aspect).area()); }

class Compaction {
 public:
  Compaction(const std::vector<Outline>& outlines, const std::vector<Placement>& placements, const CompactionOptions& options)
      : outlines_(outlines), options_(options), now_(placed(placements)), diagonal_(now_.scene.box.diagonal()) {
    // Aimed a little above the gap, so that round-off does not fall below it.
    // Charts must not touch even without a gap.
    gap_ = std::max((1 + 1e-9) * options.gap, 1e-6 * diagonal_);
    keep();
  }

  std::vector<Placement> run() {
    shrink();
    settle();
    return std::move(best_);
  }

 private:
  struct State {
    std::vector<Placement> placements;
    Scene scene;
    BoxTree tree;
    double reached;  ///< least distance of two charts
    double cost;
  };

  State placed(std::vector<Placement> placements) const {
    Scene scene = make_scene(outlines_, placements);
    BoxTree tree = edge_tree(scene);
    const double reached = smallest_gap(scene, tree), cost = box_cost(scene.box, options_.box_aspect);
    return {std::move(placements), std::move(scene), std::move(tree), reached, cost};
  }

  /// One program from the present state, unless it cannot be solved or charts come too near each other.
  std::optional<State> after(double step, bool turning) const {
    const Eigen::VectorXd motion = Program(now_.scene, now_.tree, options_, gap_, step, turning).solve();
    if (motion.size() == 0) return std::nullopt;
    State out = placed(moved(now_.placements, now_.scene, motion, turning));
    if (out.reached < 0.5 * gap_) return std::nullopt;
    return out;
  }

  void keep() {
    if (now_.reached < options_.gap || now_.cost >= best_cost_) return;
    best_cost_ = now_.cost;
    best_ = now_.placements;
  }

  void shrink() {
    constexpr int kIterations = 30;
    double step = options_.first_step;
    for (int iteration = 0; iteration < kIterations && step > 2e-5 * diagonal_; ++iteration) {
      // The last, short steps only shift: there the linear program is exact, and
      // the gap comes out as asked.
      const bool turning = iteration < kIterations - 2 && step > 1e-4 * diagonal_;
      auto trial = after(step, turning);
      if (!trial) {
        if (iteration == 0 && best_.empty()) return;  // shorter steps draw them less far apart
        step /= 4;
        continue;
      }
      if (trial->cost > now_.cost - 1e-3) step /= 2;
      now_ = std::move(*trial);
      keep();
    }
  }

  /// Charts that this left a little too near each other, by short shifts.
  void settle() {
    constexpr int kIterations = 8;
    constexpr double kInTurn = 8;                  // charts that push each other
    constexpr double kLittle = 0.1, kShort = 0.3;  // of the gap
    for (int iteration = 0; iteration < kIterations && now_.reached < options_.gap && now_.cost < best_cost_; ++iteration) {
      const double missing = gap_ - now_.reached;
      if (missing > kLittle * gap_) return;
      auto trial = after(std::max(2e-5 * diagonal_, std::min(kInTurn * missing, kShort * gap_)), false);
      if (!trial) return;
      now_ = std::move(*trial);
      keep();
    }
  }

  const std::vector<Outline>& outlines_;
  const CompactionOptions& options_;
  State now_;
  double diagonal_, gap_ = 0, best_cost_ = INFINITY;
  std::vector<Placement> best_;
};

}  // namespace

Box placed_box(const std::vector<Outline>& outlines, const std::vector<Placement>& placements) {
  return make_scene(outlines, placements).box;
}

std::vector<Placement> compact(const std::vector<Outline>& outlines, const std::vector<Placement>& placements,
                               const CompactionOptions& options) {
  return Compaction(outlines, placements, options).run();
}

}  // namespace atlas_refine
