// Hulls turned onto their lowest edges, and how near their sides may come.
#include "pack/row_poses.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "geometry/plane.h"
#include "measure/distortion.h"
#include "pack/capsule.h"
#include "pack/turns.h"

namespace atlas_refine {
namespace {

constexpr std::size_t kEdges = 4;  // of a hull that may lie on the floor: those above which the chart is lowest

double length_of(const std::vector<Vec2>& hull) {
  double length = 0;
  for (std::size_t k = 0; k < hull.size(); ++k) length += (hull[(k + 1) % hull.size()] - hull[k]).norm();
  return length;
}

/// The right side of a counterclockwise hull; `step` to go around it, backwards for that of a mirrored one.
Side right_side(const std::vector<Vec2>& hull, std::size_t step) {
  const auto lower = [](const Vec2& a, const Vec2& b) { return a.y() != b.y() ? a.y() < b.y() : a.x() > b.x(); };
  const auto higher = [](const Vec2& a, const Vec2& b) { return a.y() != b.y() ? a.y() > b.y() : a.x() > b.x(); };
  const auto top = static_cast<std::size_t>(std::min_element(hull.begin(), hull.end(), higher) - hull.begin());
  auto k = static_cast<std::size_t>(std::min_element(hull.begin(), hull.end(), lower) - hull.begin());
  Side side = {hull[k]};
  while (k != top) {
    k = (k + step) % hull.size();
    side.push_back(hull[k]);
  }
  return side;
}

RowPose pose_of(int chart, std::vector<Vec2> hull, const Turn& turn) {
  constexpr double kLevel = 1e-10;  // of the size: what lies on the floor but for rounding
  const Box box = turned_box(hull, turn);
  RowPose pose{.chart = chart,
               .motion = {turn.cosine, turn.sine, -box.min},
               .size = box.size(),
               .area = 0.5 * doubled_area(hull),
               .left = {},
               .right = {},
               .to_right_side = 0};
  for (Vec2& p : hull) {
    p = pose.motion.apply(p);
    if (p.y() < kLevel * pose.size.norm()) p.y() = 0;
    if (p.y() > pose.size.y() - kLevel * pose.size.norm()) p.y() = pose.size.y();
  }
  pose.right = right_side(hull, 1);
  for (Vec2& p : hull) p.x() = -p.x();
  pose.left = right_side(hull, hull.size() - 1);
  for (std::size_t k = 0; k + 1 < pose.right.size(); ++k) {
    const Vec2 &a = pose.right[k], &b = pose.right[k + 1];
    pose.to_right_side += 0.5 * (a.x() + b.x()) * (b.y() - a.y());
  }
  return pose;
}

/// Those that lay an edge of the hull on the floor, the lowest of them.
std::vector<Turn> lowest_turns(const std::vector<Vec2>& hull) {
  std::vector<std::pair<double, Turn>> by_height;
  for (std::size_t k = 0; k < hull.size(); ++k) {
    const Vec2 along = (hull[(k + 1) % hull.size()] - hull[k]).normalized();
    const Turn turn{along.x(), -along.y()};
    by_height.emplace_back(turned_box(hull, turn).size().y(), turn);
  }
  std::stable_sort(by_height.begin(), by_height.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<Turn> out;
  for (const auto& candidate : by_height) {
    const Turn& turn = candidate.second;
    const auto parallel = [&](const Turn& other) { return std::abs(turn.cosine * other.sine - turn.sine * other.cosine) < 1e-9; };
    if (out.size() < kEdges && std::none_of(out.begin(), out.end(), parallel)) out.push_back(turn);
  }
  return out;
}

std::vector<Turn> turns_in_row(const Outline& outline, const std::vector<Vec2>& hull) {
  if (outline.rotate == Rotate::None) return {{}};
  std::vector<Turn> out;
  const bool any = outline.rotate == Rotate::Any && hull.size() > 2;
  for (const Turn& turn : any ? lowest_turns(hull) : std::vector<Turn>{{}, Turn{}.quarter_turned()}) {
    out.push_back(turn);
    out.push_back(turn.quarter_turned().quarter_turned());
  }
  return out;
}

/// The largest x of the side with the gap around it.
double reach(const Side& side, double gap, double y) {
  double x = Capsule{side[0], side[0], gap}.right_at(y);
  for (std::size_t k = 0; k + 1 < side.size(); ++k) x = std::max(x, Capsule{side[k], side[k + 1], gap}.right_at(y));
  return x;
}

}  // namespace

RowPoses::RowPoses(const std::vector<Outline>& outlines, double gap)
    : least_height(outlines.size(), INFINITY), by_height(outlines.size()) {
  for (int c = 0; c < static_cast<int>(outlines.size()); ++c) {
    const std::vector<Vec2> hull = convex_hull(outlines[c]);
    area += 0.5 * doubled_area(hull);
    grown += 0.5 * doubled_area(hull) + 0.5 * gap * length_of(hull);
    for (const Turn& turn : turns_in_row(outlines[c], hull)) {
      all.push_back(pose_of(c, hull, turn));
      least_height[c] = std::min(least_height[c], all.back().size.y());
    }
  }
  std::stable_sort(all.begin(), all.end(), [](const RowPose& a, const RowPose& b) { return a.size.y() > b.size.y(); });
  std::iota(by_height.begin(), by_height.end(), 0);
  std::stable_sort(by_height.begin(), by_height.end(), [&](int a, int b) { return least_height[a] > least_height[b]; });
}

double row_distance(const Side& right, const Side& left, double gap) {
  double x = -INFINITY;
  for (const Vec2& p : right) x = std::max(x, p.x() + reach(left, gap, p.y()));
  for (const Vec2& p : left) x = std::max(x, p.x() + reach(right, gap, p.y()));
  return x;
}

}  // namespace atlas_refine
