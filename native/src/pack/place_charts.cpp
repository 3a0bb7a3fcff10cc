// Outlines to the packer and placements back, repeated until the gap fits the box that came out.
#include "pack/place_charts.h"

#include <algorithm>
#include <cmath>

#include "measure/distortion.h"
#include "pack/pack_charts.h"

namespace atlas_refine {
namespace {

// What is kept beyond the gap: the squeeze starts in a slightly larger box, and rounding to single precision must not lose it.
// Rather too large a guess of the box, whose gap costs little, than a second round of packing.
constexpr double kLikelyPe = 0.6;
constexpr double kMoreThanGap = 1.0065;

Outline outline_of(const Chart& chart) {
  Outline outline;
  for (const auto& loop : chart.boundary_loops) {
    auto& points = outline.loops.emplace_back();
    for (int v : loop) points.push_back(chart.uvs[v]);
  }
  return outline;
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
  PackOptions pack{.gap = 0,
                   .box_aspect = options.box_aspect,
                   .target_pe = options.target_pe,
                   .seed = options.seed,
                   .threads = options.threads,
                   .tick = [&](double fraction) { monitor.report(fraction); }};
  pack.gap = options.gap.length(sides_of_area(area / kLikelyPe, options.box_aspect));
  Packing packing = pack_charts(outlines, areas, pack);
  // A larger gap makes a larger box; a little more than asked each time ends this after one or two rounds.
  for (double more = 1.007; charts.size() > 1 && pack.gap < kMoreThanGap * options.gap.length(packing.box.size()); more += 0.01) {
    pack.gap = more * options.gap.length(packing.box.size());
    packing = pack_charts(outlines, areas, pack);
  }
  std::vector<Chart> placed = charts;
  for (std::size_t c = 0; c < placed.size(); ++c) {
    for (Vec2& uv : placed[c].uvs) uv = packing.placements[c].apply(uv);
  }
  return placed;
}

}  // namespace atlas_refine
