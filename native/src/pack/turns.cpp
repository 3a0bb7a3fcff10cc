// Rotations by rotating calipers: a smallest box has a side along a hull edge,
// or touches its aspect between two such turns.
#include "pack/turns.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/convex_hull.h"
#include "measure/distortion.h"

namespace atlas_refine {
namespace {

Turn turn_of(double angle_rad) { return {std::cos(angle_rad), std::sin(angle_rad)}; }

/// Angles in [0, pi / 2), ascending, at which some hull edge is parallel to an
/// axis.
std::vector<double> caliper_angles(const std::vector<Vec2>& hull) {
  constexpr double kQuarter = std::numbers::pi / 2;
  std::vector<double> angles;
  for (size_t i = 0; i < hull.size(); ++i) {
    const Vec2 edge = hull[(i + 1) % hull.size()] - hull[i];
    double angle = std::fmod(-std::atan2(edge.y(), edge.x()) + 4 * kQuarter, kQuarter);
    if (angle >= kQuarter || angle < 0) angle = 0;
    angles.push_back(angle);
  }
  std::sort(angles.begin(), angles.end());
  angles.erase(std::unique(angles.begin(), angles.end(), [](double a, double b) { return b - a < 1e-12; }), angles.end());
  return angles;
}

/// The turn strictly between two caliper turns at which width = aspect *
/// height: both are linear in (cos, sin) there. Returns a negative angle where
/// there is none.
double balanced_angle(const std::vector<Vec2>& hull, double from, double to, double aspect) {
  const Turn middle = turn_of(0.5 * (from + to));
  const auto span = [&](const Vec2& direction) {
    const auto [low, high] = std::minmax_element(
        hull.begin(), hull.end(), [&](const Vec2& a, const Vec2& b) { return a.dot(direction) < b.dot(direction); });
    return Vec2(*high - *low);
  };
  const Vec2 w = span({middle.cosine, -middle.sine}), h = span({middle.sine, middle.cosine});
  // w.x cos - w.y sin = aspect * (h.x sin + h.y cos)
  const double angle = std::atan2(w.x() - aspect * h.y(), w.y() + aspect * h.x());
  for (const double candidate : {angle, angle + std::numbers::pi, angle - std::numbers::pi}) {
    if (candidate > from && candidate < to) return candidate;
  }
  return -1;
}

}  // namespace

std::vector<Vec2> convex_hull(const Outline& outline) {
  std::vector<Vec2> points;
  for (const auto& loop : outline.loops) points.insert(points.end(), loop.begin(), loop.end());
  return convex_hull(points);
}

Box turned_box(const std::vector<Vec2>& points, const Turn& turn) {
  Box box{Vec2::Constant(INFINITY), Vec2::Constant(-INFINITY)};
  for (const Vec2& p : points) {
    const Vec2 q = turn.apply(p);
    box.min = box.min.cwiseMin(q);
    box.max = box.max.cwiseMax(q);
  }
  return box;
}

std::vector<Turn> small_box_turns(const std::vector<Vec2>& hull, int count) {
  const std::vector<double> angles = caliper_angles(hull);
  const int n = static_cast<int>(angles.size());
  std::vector<std::pair<double, int>> by_area;
  std::vector<double> areas;
  for (double angle : angles) areas.push_back(turned_box(hull, turn_of(angle)).area());
  for (int i = 0; i < n; ++i) {
    if (areas[i] <= areas[(i + 1) % n] && areas[i] <= areas[(i + n - 1) % n]) by_area.emplace_back(areas[i], i);
  }
  std::sort(by_area.begin(), by_area.end());
  std::vector<Turn> turns;
  if (by_area.empty()) turns.push_back({});  // a single point
  for (int k = 0; k < std::min<int>(count, by_area.size()); ++k) turns.push_back(turn_of(angles[by_area[k].second]));
  return turns;
}

std::vector<Turn> smallest_box_turns(const std::vector<Vec2>& hull, double tolerance, std::size_t count) {
  std::vector<Turn> turns;
  std::vector<double> areas;
  for (double angle : caliper_angles(hull)) {
    turns.push_back(turn_of(angle));
    areas.push_back(turned_box(hull, turns.back()).area());
  }
  if (turns.empty()) return {{}};  // a single point
  const double most = (1 + tolerance) * *std::min_element(areas.begin(), areas.end());
  std::vector<Turn> out;
  for (std::size_t k = 0; k < turns.size() && out.size() < count; ++k) {
    if (areas[k] <= most) out.push_back(turns[k]);
  }
  return out;
}

std::vector<Turn> turns_to_try(const Outline& outline, int count) {
  if (outline.rotate == Rotate::None) return {{}};
  std::vector<Turn> turns;
  const bool any = outline.rotate == Rotate::Any;
  for (Turn turn : any ? small_box_turns(convex_hull(outline), count) : std::vector<Turn>{{}}) {
    for (int quarter = 0; quarter < 4; ++quarter, turn = turn.quarter_turned()) turns.push_back(turn);
  }
  return turns;
}

std::vector<std::vector<Turn>> turns_aslant(const std::vector<Outline>& outlines, double aspect, double area) {
  constexpr int kMost = 3;          // on the diagonal: more are best left upright, side by side
  constexpr double kSmaller = 0.9;  // than the box that holds it upright
  std::vector<std::vector<Turn>> out(outlines.size());
  const auto box_at = [&](const std::vector<Vec2>& points, const Turn& turn) {
    return box_of_aspect(turned_box(points, turn), aspect).area();
  };
  int count = 0;
  for (std::size_t k = 0; k < outlines.size() && aspect > 0; ++k) {
    if (outlines[k].rotate != Rotate::Any || box_at(outlines[k].loops[0], {}) <= area) continue;
    const std::vector<Vec2> hull = convex_hull(outlines[k]);
    double upright = INFINITY;
    for (const Turn& turn : turns_to_try(outlines[k], 2)) upright = std::min(upright, box_at(hull, turn));
    if (upright <= area) continue;
    if (++count > kMost) return std::vector<std::vector<Turn>>(outlines.size());
    const Turn turn = best_turn(hull, aspect);
    if (box_at(hull, turn) < kSmaller * upright) out[k] = {turn, turn.quarter_turned().quarter_turned()};
  }
  return out;
}

Turn best_turn(const Outline& outline, double aspect) {
  const std::vector<Vec2> hull = convex_hull(outline);
  if (outline.rotate == Rotate::Any) return best_turn(hull, aspect);
  const auto cost = [&](const Turn& turn) { return box_of_aspect(turned_box(hull, turn), aspect).area(); };
  constexpr double kBetter = 1 - 1e-9;  // by more than rounding
  const Turn upright, turned = upright.quarter_turned();
  return outline.rotate == Rotate::QuarterTurns && cost(turned) < kBetter * cost(upright) ? turned : upright;
}

Turn best_turn(const std::vector<Vec2>& hull, double aspect) {
  constexpr double kQuarter = std::numbers::pi / 2;
  std::vector<double> angles = caliper_angles(hull);
  if (aspect > 0) {
    const size_t n = angles.size();
    for (size_t i = 0; i < n; ++i) {
      const double from = angles[i], to = i + 1 < n ? angles[i + 1] : angles[0] + kQuarter;
      for (const double lying : {0.0, kQuarter}) {
        const double angle = balanced_angle(hull, from + lying, to + lying, aspect);
        if (angle >= 0) angles.push_back(angle);
      }
      angles.push_back(angles[i] + kQuarter);
    }
  }
  Turn best;
  double best_cost = INFINITY;
  for (double angle : angles) {
    const Turn turn = turn_of(angle);
    const double cost = box_of_aspect(turned_box(hull, turn), aspect).area();
    if (cost < best_cost) best_cost = cost, best = turn;
  }
  return best;
}

}  // namespace atlas_refine
