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
#include "pack/pack_in_frame.h"
#include "pack/room_for_gap.h"
#include "pack/straight_border.h"
#include "support/profile.h"

namespace atlas_refine {
namespace {

// Rather too large a guess of a few charts' box, whose gap costs little, than a second round of packing.
constexpr double kLikelyPe = 0.6;
// With half the gap around them charts take this part of the box, or where they are hoped to reach the target up to the other.
constexpr double kLikelyTaken = 0.8, kMostTaken = 0.86;
// What is kept beyond the gap: the squeeze starts in a slightly larger box, and rounding to single precision must not lose it.
constexpr double kMoreThanGap = 1.0065, kFirstMore = 1.007;
// Where many charts ask for a wide gap, the box grows faster than the gap can follow it.
constexpr int kRounds = 10;
// Length of a chart per side of the square that holds all charts: beyond it the box's gap is as wide as the charts.
constexpr double kLongestChart = 400;
constexpr double kFrameMargin = 0.0018;  // of the frame's height, along its walls: the squeeze needs some room to start

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

void require_no_needles(const std::vector<Chart>& charts) {
  const std::vector<Needle> needles = needles_among(charts);
  if (needles.empty()) return;
  const Chart& chart = charts[needles.front().chart];
  throw RefineError(ErrorCode::BadInput, "pack", "chart " + std::to_string(chart.number) + " " + needles.front().words,
                    chart.number, face_with_longest_side(chart));
}

/// What the packer may do with a chart, which is first turned onto an axis where that is asked.
Outline prepared_outline(const PlaceOptions& options, Chart& chart) {
  Outline outline = outline_of(chart);
  outline.rotate = options.rotate;
  if (!options.align_axes || options.rotate == Rotate::None) return outline;
  const auto turn = turn_onto_axis(chart);
  if (!turn) return outline;
  for (Vec2& uv : chart.uvs) uv = turn->apply(uv);
  outline = outline_of(chart);
  outline.rotate = Rotate::QuarterTurns;
  return outline;
}

/// Charts, and what the packer gets of them.
struct Prepared {
  std::vector<Chart> charts;
  std::vector<Outline> outlines;
  std::vector<double> areas;

  Prepared(const std::vector<Chart>& given, const PlaceOptions& options) : charts(given) {
    for (Chart& chart : charts) {
      outlines.push_back(prepared_outline(options, chart));
      areas.push_back(uv_area(chart));
    }
  }

  std::vector<Chart> moved(const std::vector<Placement>& placements) && {
    for (std::size_t c = 0; c < charts.size(); ++c) {
      for (Vec2& uv : charts[c].uvs) uv = placements[c].apply(uv);
    }
    return std::move(charts);
  }
};

/// The gap in the box that charts are likely to need: in that which reaches the target, where these may be packed so well.
double likely_gap(const std::vector<Chart>& charts, const PlaceOptions& options, const RoomForGap& room) {
  const auto gap_at_pe = [&](double pe) { return options.gap.length(sides_of_area(uv_area(charts) / pe, options.box_aspect)); };
  const double at_target = kFirstMore * gap_at_pe(options.target_pe);
  const bool hopeful =
      room.taken(at_target, sides_of_area(uv_area(charts) / options.target_pe, options.box_aspect)) <= kMostTaken;
  const double likely = hopeful ? at_target : room.gap_at(kLikelyTaken).value_or(at_target);
  return charts.size() > kManyCharts ? likely : std::max(likely, gap_at_pe(kLikelyPe));
}

/// Where that of a packing was too small for its box: as if the larger one were packed as well. Nothing where nobody packs it.
std::optional<double> next_gap(const RoomForGap& room, double gap, const Packing& packing, double wanted) {
  const auto as_well = room.gap_at(std::max(kLikelyTaken, room.taken(gap, packing.box.size())));
  if (!as_well) return std::nullopt;
  return std::max(wanted, *as_well);
}

}  // namespace

std::vector<Needle> needles_among(const std::vector<Chart>& charts) {
  const double side = std::sqrt(uv_area(charts));
  std::vector<Needle> out;
  for (int c = 0; c < static_cast<int>(charts.size()); ++c) {
    const double sides = box_of_points(charts[c].uvs).diagonal() / side;
    if (sides <= kLongestChart) continue;
    char words[96];
    std::snprintf(words, sizeof words, "is too long to be packed: %.0f sides of a square that holds all charts", sides);
    out.push_back({c, words});
  }
  return out;
}

std::vector<Chart> place_charts(const std::vector<Chart>& charts, const PlaceOptions& options, Monitor& monitor) {
  const PhaseScope scope(Phase::Pack);
  Prepared prepared(charts, options);
  const std::vector<Outline>& outlines = prepared.outlines;
  const std::vector<double>& areas = prepared.areas;
  require_no_needles(charts);
  require_room(options.gap, options.box_aspect, charts.size());
  const RoomForGap room(charts, options.gap, options.box_aspect);
  PackOptions pack{.gap = likely_gap(charts, options, room),
                   .box_aspect = options.box_aspect,
                   .target_pe = options.target_pe,
                   .seed = options.seed,
                   .threads = options.threads,
                   .search = options.search,
                   .tick = [&](double fraction) { monitor.report(fraction); }};
  Packing packing = pack_charts(outlines, areas, pack);
  // A larger gap makes a larger box; a little more than asked each time ends this after one or two rounds.
  const auto wanted = [&] {
    return std::sqrt(std::max(1.0, packing.pe / options.most_pe)) * options.gap.length(packing.box.size());
  };
  for (int round = 0; charts.size() > 1 && pack.gap < kMoreThanGap * wanted(); ++round) {
    const auto next = next_gap(room, pack.gap, packing, wanted());
    if (round == kRounds || !next) refuse_gap(options.gap, charts.size());
    const double before = pack.gap;
    pack.gap = (kFirstMore + 0.01 * round) * *next;
    const auto apart =
        options.search == PackSearch::Thorough ? with_larger_gap(outlines, areas, packing, before, pack) : std::nullopt;
    // Where the target was reached, another search is likely to reach it, too.
    const bool will_do = apart && (apart->pe >= options.target_pe || packing.pe < options.target_pe);
    packing = will_do ? *apart : pack_charts(outlines, areas, pack);
  }
  return std::move(prepared).moved(packing.placements);
}

std::optional<std::vector<Chart>> place_in_rows(const std::vector<Chart>& charts, const PlaceOptions& options, Monitor& monitor) {
  const PhaseScope scope(Phase::Pack);
  Prepared prepared(charts, options);
  // In a larger box than that of the target the gap would be wider.
  const Vec2 box = sides_of_area(uv_area(charts) / options.target_pe, options.box_aspect);
  const auto packing = pack_charts_in_rows(prepared.outlines, prepared.areas,
                                           {.gap = kFirstMore * options.gap.length(box),
                                            .box_aspect = options.box_aspect,
                                            .target_pe = options.target_pe,
                                            .tick = [&](double fraction) { monitor.report(fraction); }});
  if (!packing) return std::nullopt;
  return std::move(prepared).moved(packing->placements);
}

std::optional<PlacedCharts> place_around(const std::vector<Chart>& charts, const Freedoms& freedom, const PlaceOptions& options,
                                         Monitor& monitor) {
  const PhaseScope scope(Phase::Pack);
  const Vec2 frame(options.box_aspect, 1);
  PlacedCharts out{.charts = charts};
  std::vector<Outline> outlines, obstacles;
  std::vector<std::size_t> movable;
  FrameOptions pack{.frame = frame,
                    .margin = kFrameMargin,
                    .gap = kMoreThanGap * options.gap.length(frame),
                    .seed = options.seed,
                    .threads = options.threads,
                    .tick = [&](double fraction) { monitor.report(fraction); }};
  double area = 0, taken = 0;
  for (std::size_t c = 0; c < charts.size(); ++c) {
    if (is_fixed(freedom, c)) {
      obstacles.push_back(outline_of(charts[c]));
      taken += area_within(charts[c], {Vec2::Zero(), frame});
    } else {
      movable.push_back(c);
      outlines.push_back(prepared_outline(options, out.charts[c]));
      area += uv_area(charts[c]);
    }
  }
  pack.enough = std::sqrt(std::max(0.01 * frame.prod(), options.target_pe * frame.prod() - taken) / area);
  const auto packing = pack_in_frame(outlines, obstacles, pack);
  if (!packing) return std::nullopt;
  out.frame = frame / packing->scale;
  for (std::size_t k = 0; k < movable.size(); ++k) {
    for (Vec2& uv : out.charts[movable[k]].uvs) uv = packing->placements[k].apply(uv);
  }
  for (std::size_t c = 0; c < charts.size(); ++c) {
    if (!is_fixed(freedom, c)) continue;
    for (Vec2& uv : out.charts[c].uvs) uv *= out.frame.y();
  }
  return out;
}

std::vector<Vec2> moved_likewise(std::vector<Vec2> uvs, const std::vector<Vec2>& from, const std::vector<Vec2>& to) {
  const auto nearer = [&](const Vec2& a, const Vec2& b) { return (a - from[0]).squaredNorm() < (b - from[0]).squaredNorm(); };
  const auto farthest = std::max_element(from.begin(), from.end(), nearer) - from.begin();
  const Vec2 before = from[farthest] - from[0], after = to[farthest] - to[0];
  const Vec2 turn = Vec2(before.dot(after), before.x() * after.y() - before.y() * after.x()).normalized();
  const Placement motion{turn.x(), turn.y(), Vec2::Zero()};
  for (Vec2& uv : uvs) uv = to[0] + motion.apply(uv - from[0]);
  return uvs;
}

}  // namespace atlas_refine
