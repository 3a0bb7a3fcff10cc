// Sequential linear programming: the distances of near vertices and edges,
// linearised in all charts' motions.
#include "pack/compaction.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <tuple>

#include "geometry/boundary.h"
#include "geometry/box_tree.h"
#include "geometry/predicates.h"
#include "measure/distortion.h"
#include "pack/linear_program.h"
#include "pack/turns.h"

namespace atlas_refine {
namespace {
struct Edge {
  int chart;
  Vec2 a, b;
};

/// The charts where they lie now.
struct Scene {
  std::vector<char> turnable;    ///< charts that may get any rotation
  std::vector<int> first_edges;  ///< of each chart in edges, and their end
  std::vector<Edge> edges;       ///< all charts' boundary edges; `a` runs through all vertices
  std::vector<Vec2> centres;     ///< of each chart's bounding box
  std::vector<double> radii;     ///< of each chart about its centre
  std::vector<Box> boxes;
  Box box;
};

Scene make_scene(const std::vector<Outline>& outlines, const std::vector<Placement>& placements) {
  Scene scene;
  const auto empty = Box{Vec2::Constant(INFINITY), Vec2::Constant(-INFINITY)};
  scene.box = empty;
  for (size_t c = 0; c < outlines.size(); ++c) {
    const size_t first = scene.edges.size();
    scene.first_edges.push_back(static_cast<int>(first));
    Box box = empty;
    for (const auto& loop : outlines[c].loops) {
      for (size_t k = 0; k < loop.size(); ++k) {
        const Vec2 a = placements[c].apply(loop[k]), b = placements[c].apply(loop[(k + 1) % loop.size()]);
        scene.edges.push_back({static_cast<int>(c), a, b});
        box = united(box, {a, a});
      }
    }
    scene.turnable.push_back(outlines[c].rotate == Rotate::Any);
    scene.boxes.push_back(box);
    scene.centres.push_back(0.5 * (box.min + box.max));
    double radius = 0;
    for (size_t k = first; k < scene.edges.size(); ++k) radius = std::max(radius, (scene.edges[k].a - scene.centres[c]).norm());
    scene.radii.push_back(std::max(radius, 1e-300));
    scene.box = united(scene.box, box);
  }
  scene.first_edges.push_back(static_cast<int>(scene.edges.size()));
  return scene;
}

BoxTree edge_tree(const Scene& scene) {
  std::vector<Box> boxes;
  std::vector<int> labels;
  for (const Edge& edge : scene.edges) {
    boxes.push_back({edge.a.cwiseMin(edge.b), edge.a.cwiseMax(edge.b)});
    labels.push_back(edge.chart);
  }
  return {std::move(boxes), std::move(labels)};
}

Vec2 nearest_point(const Vec2& p, const Edge& edge) {
  return edge.a + closest_on_segment(p, edge.a, edge.b).along * (edge.b - edge.a);
}

/// The point lies inside the chart: its outline winds about it.
bool inside(const Scene& scene, int chart, const Vec2& p) {
  int winding = 0;
  for (int k = scene.first_edges[chart]; k < scene.first_edges[chart + 1]; ++k) {
    const Edge& edge = scene.edges[k];
    if ((edge.a.y() > p.y()) == (edge.b.y() > p.y())) continue;
    if (orientation(edge.a, edge.b, p) == (edge.b.y() > edge.a.y() ? 1 : -1)) winding += edge.b.y() > edge.a.y() ? 1 : -1;
  }
  return winding != 0;
}

bool any_chart_inside_another(const Scene& scene) {
  std::vector<int> charts(scene.boxes.size());
  std::iota(charts.begin(), charts.end(), 0);
  const BoxTree tree(scene.boxes, charts);
  const double touching = 0;
  bool found = false;
  for (const int chart : charts) {
    const Vec2& corner = scene.edges[scene.first_edges[chart]].a;
    tree.visit_within({corner, corner}, touching, chart, [&](int other) {
      found = inside(scene, other, corner);
      return !found;
    });
    if (found) return true;
  }
  return false;
}

/// Smallest distance between the boundaries of two charts; 0 where charts overlap.
double smallest_gap(const Scene& scene, const BoxTree& tree) {
  double nearest = scene.box.diagonal();
  for (const Edge& edge : scene.edges) {
    tree.visit_within({edge.a, edge.a}, nearest, edge.chart, [&](int other) {
      nearest = std::min(nearest, (edge.a - nearest_point(edge.a, scene.edges[other])).norm());
      return true;
    });
  }
  const double touching = 0;
  for (const Edge& edge : scene.edges) {
    const Box span{edge.a.cwiseMin(edge.b), edge.a.cwiseMax(edge.b)};
    tree.visit_within(span, touching, edge.chart, [&](int other) {
      if (segments_touch(edge.a, edge.b, scene.edges[other].a, scene.edges[other].b)) nearest = 0;
      return nearest > 0;
    });
    if (nearest == 0) return 0;
  }
  return any_chart_inside_another(scene) ? 0 : nearest;
}

/// A farther edge in much the same direction is left to the next, shorter step. Where steps only shift these are the last, and a
/// few are taken.
bool is_new(const Vec2& normal, const std::vector<Vec2>& normals, bool turning) {
  constexpr double kAlike = 0.9, kEqual = 1 - 1e-9;
  constexpr std::size_t kFew = 3;
  if (!turning && normals.size() >= kFew) return false;
  const double most = turning ? kAlike : kEqual;
  return std::none_of(normals.begin(), normals.end(), [&](const Vec2& n) { return n.dot(normal) > most; });
}

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
    for (const Edge& edge : scene_.edges) {
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

  struct Contact {
    double distance;
    int vertex, edge;  ///< entries of the scene's edges
    Vec2 foot;
  };

  /// Constraints for vertices of one stretch: its nearest edges in each
  /// direction, for each chart that it faces.
  void add_contacts_of(int chart_of_stretch, std::vector<Contact>& near) {
    std::sort(near.begin(), near.end(), [&](const Contact& p, const Contact& q) {
      const int a = scene_.edges[p.edge].chart, b = scene_.edges[q.edge].chart;
      return std::tie(a, p.distance, p.vertex, p.edge) < std::tie(b, q.distance, q.vertex, q.edge);
    });
    std::vector<Vec2> normals;
    int faced = -1;
    for (const Contact& contact : near) {
      const int chart = scene_.edges[contact.edge].chart;
      if (chart != faced) normals.clear();
      faced = chart;
      const Vec2& vertex = scene_.edges[contact.vertex].a;
      const Vec2 normal = (vertex - contact.foot) / contact.distance;
      if (!is_new(normal, normals, turning_)) continue;
      normals.push_back(normal);
      auto& row = inequalities_.emplace_back();
      add_motion(row, chart_of_stretch, vertex, normal);
      add_motion(row, chart, contact.foot, -normal);
      row.bound = gap_ - contact.distance;
    }
    near.clear();
  }

  /// Where steps turn, vertices of a stretch that is short against the step are one: what they bar is nearly the same.
  bool ends_stretch(int k, double& length) const {
    constexpr double kOfStep = 0.5;
    const Edge& edge = scene_.edges[k];
    length += (edge.b - edge.a).norm();
    const bool last = k + 1 == scene_.first_edges[edge.chart + 1] || scene_.edges[k + 1].a != edge.b;
    if (turning_ && !last && length < kOfStep * step_) return false;
    length = 0;
    return true;
  }

  void add_contacts() {
    const double reach = gap_ + 4 * step_;
    std::vector<Contact> near;
    double length = 0;  // of the stretch
    for (int k = 0; k < static_cast<int>(scene_.edges.size()); ++k) {
      const Edge& edge = scene_.edges[k];
      if (k == scene_.first_edges[edge.chart]) options_.poll();
      tree_.visit_within({edge.a, edge.a}, reach, edge.chart, [&](int other) {
        const Vec2 foot = nearest_point(edge.a, scene_.edges[other]);
        const double distance = (edge.a - foot).norm();
        if (distance > 0 && distance <= reach) near.push_back({distance, k, other, foot});
        return true;
      });
      if (ends_stretch(k, length)) add_contacts_of(edge.chart, near);
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
