// Steiner's formula for charts and box; what follows is quadratic in the box's side.
#include "pack/room_for_gap.h"

#include <cmath>
#include <numbers>

#include "measure/distortion.h"

namespace atlas_refine {

RoomForGap::RoomForGap(const std::vector<Chart>& charts, const Gap& gap, double box_aspect)
    : area_(uv_area(charts)),
      perimeter_(uv_perimeter(charts)),
      disks_(0.25 * std::numbers::pi * static_cast<double>(charts.size())),
      unit_(sides_of_area(1, box_aspect)),
      gap_of_unit_(gap.length(unit_)) {
  for (const Chart& chart : charts) lengths_ += std::sqrt(uv_area(chart) / area_);
}

double RoomForGap::grown(double gap) const { return area_ + 0.5 * perimeter_ * gap + disks_ * gap * gap; }

double RoomForGap::taken(double gap, const Vec2& box) const { return grown(gap) / ((box.x() + gap) * (box.y() + gap)); }

std::optional<double> RoomForGap::gap_at(double part) const {
  // part side^2 (unit + g) = area + perimeter g side / 2 + disks g^2 side^2, where the gap is g side
  const double g = gap_of_unit_, border = 0.25 * perimeter_ * g;
  const double square = part * (unit_.x() + g) * (unit_.y() + g) - disks_ * g * g;
  if (square <= 0) return std::nullopt;
  return g * (border + std::sqrt(border * border + square * area_)) / square;
}

double RoomForGap::most_pe() const {
  // pe + sqrt(pi) g lengths sqrt(pe) + disks g^2 = (x + g) (y + g)
  const double g = gap_of_unit_, half = 0.5 * std::sqrt(std::numbers::pi) * g * lengths_;
  const double free = (unit_.x() + g) * (unit_.y() + g) - disks_ * g * g;
  if (free <= 0) return 0;
  const double root = free / (half + std::sqrt(half * half + free));
  return root * root;
}

}  // namespace atlas_refine
