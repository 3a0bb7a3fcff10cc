// Outlines to the packer and placements back, repeated until the gap fits the box that came out.
#include "pack/place_charts.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>

#include "atlas_refine/error.h"
#include "measure/distortion.h"
#include "pack/pack_charts.h"

namespace atlas_refine {
namespace {

// What is kept beyond the gap: the squeeze starts in a slightly larger box, and rounding to single precision must not lose it.
// Rather too large a guess of the box, whose gap costs little, than a second round of packing.
constexpr double kLikelyPe = 0.6;
constexpr double kMoreThanGap = 1.0065;
// Where many charts ask for a wide gap, the box grows faster than the gap can follow it.
constexpr int kRounds = 10;
// Length of a chart per side of the square that holds all charts: beyond it the box's gap is as wide as the charts.
constexpr double kLongestChart = 400;

Outline outline_of(const Chart& chart) {
  Outline outline;
  for (const auto& loop : chart.boundary_loops) {
    auto& points = outline.loops.emplace_back();
    for (int v : loop) points.push_back(chart.uvs[v]);
  }
  return outline;
}

[[noreturn]] void refuse_gap(const Gap& gap, std::size_t charts) {
  char fraction[32];
  std::snprintf(fraction, sizeof fraction, "%g", gap.value);
  throw RefineError(ErrorCode::BoundNotReached, "pack",
                    std::string("a gap of ") + fraction + " of the box leaves no room for " + std::to_string(charts) + " charts");
}

/// Disks of the gap's width about a point of each chart are apart and reach out of the box by half the gap at most.
void require_room(const Gap& gap, double box_aspect, std::size_t charts) {
  const Vec2 box = sides_of_area(1, box_aspect);
  const double g = gap.length(box), disks = 0.25 * std::numbers::pi * g * g * static_cast<double>(charts);
  if (charts > 1 && disks > (box.x() + g) * (box.y() + g)) refuse_gap(gap, charts);
}

double longest_side(const Chart& chart, const Triangle& t) {
  return std::max({(chart.uvs[t[1]] - chart.uvs[t[0]]).norm(), (chart.uvs[t[2]] - chart.uvs[t[1]]).norm(),
                   (chart.uvs[t[0]] - chart.uvs[t[2]]).norm()});
}

int face_with_longest_side(const Chart& chart) {
  const auto worst = std::max_element(chart.triangles.begin(), chart.triangles.end(), [&](const Triangle& a, const Triangle& b) {
    return longest_side(chart, a) < longest_side(chart, b);
  });
  return chart.triangle_faces[worst - chart.triangles.begin()];
}

/// A needle has no size that gap and box could go by.
void require_no_needles(const std::vector<Chart>& charts, double area) {
  const double side = std::sqrt(area);
  for (int c = 0; c < static_cast<int>(charts.size()); ++c) {
    const double times = uv_box({charts[c]}).diagonal() / side;
    if (times <= kLongestChart) continue;
    char text[32];
    std::snprintf(text, sizeof text, "%.0f", times);
    throw RefineError(
        ErrorCode::BadInput, "pack",
        "chart " + std::to_string(c) + " is too long to be packed: " + text + " sides of a square that holds all charts", c,
        face_with_longest_side(charts[c]));
  }
}

}  // namespace

std::vector<Chart> place_charts(const std::vector<Chart>& charts, const PlaceOptions& options, Monitor& monitor) {
  std::vector<Outline> outlines;
  std::vector<double> areas;
  double area = 0;
  for (const Chart& chart : charts) {
    outlines.push_back(outline_of(chart));
    areas.push_back(uv_area(chart));
    area += areas.back();
  }
  require_no_needles(charts, area);
  require_room(options.gap, options.box_aspect, charts.size());
  PackOptions pack{.gap = 0,
                   .box_aspect = options.box_aspect,
                   .target_pe = options.target_pe,
                   .seed = options.seed,
                   .threads = options.threads,
                   .tick = [&](double fraction) { monitor.report(fraction); }};
  pack.gap = options.gap.length(sides_of_area(area / kLikelyPe, options.box_aspect));
  Packing packing = pack_charts(outlines, areas, pack);
  // A larger gap makes a larger box; a little more than asked each time ends this after one or two rounds.
  const auto wanted = [&] { return options.gap.length(packing.box.size()); };
  for (int round = 0; charts.size() > 1 && pack.gap < kMoreThanGap * wanted(); ++round) {
    if (round == kRounds) refuse_gap(options.gap, charts.size());
    pack.gap = (1.007 + 0.01 * round) * wanted();
    packing = pack_charts(outlines, areas, pack);
  }
  std::vector<Chart> placed = charts;
  for (std::size_t c = 0; c < placed.size(); ++c) {
    for (Vec2& uv : placed[c].uvs) uv = packing.placements[c].apply(uv);
  }
  return placed;
}

}  // namespace atlas_refine
