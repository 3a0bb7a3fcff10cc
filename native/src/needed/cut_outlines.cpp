// Loops of the border divided by a chord, thinned out, packed roughly.
#include "needed/cut_outlines.h"

#include <algorithm>
#include <cmath>

#include "geometry/plane.h"
#include "geometry/predicates.h"
#include "measure/distortion.h"
#include "pack/pack_charts.h"

namespace atlas_refine {
namespace {

constexpr double kSpacing = 0.02;  // of the root of all area: of vertices nearer to each other one is enough
constexpr double kLikelyPe = 0.6;  // what the gap is guessed by
// E_d that charts lose for what the box of the unbent charts is larger than the bound asks, as a fraction: a first guess, of
// which forecasts tell more.
constexpr double kBoxPrice = 0.045;

using Loops = std::vector<OutlineLoop>;

double area_of(const std::vector<Vec2>& loop) { return 0.5 * doubled_area(loop); }

std::vector<Vec2> thinned(const std::vector<Vec2>& loop, double spacing) {
  std::vector<Vec2> out;
  for (const Vec2& p : loop) {
    if (out.empty() || (p - out.back()).norm() >= spacing) out.push_back(p);
  }
  return out.size() < 3 ? loop : out;
}

bool crosses_itself(const std::vector<Vec2>& loop) {
  const std::size_t n = loop.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 &a = loop[i], &b = loop[(i + 1) % n];
    const Vec2 low = a.cwiseMin(b), high = a.cwiseMax(b);
    for (std::size_t j = i + 2; j < n; ++j) {
      const Vec2 &p = loop[j], &q = loop[(j + 1) % n];
      if ((j + 1) % n == i || (p.cwiseMin(q).array() > high.array()).any() || (p.cwiseMax(q).array() < low.array()).any())
        continue;
      if (segments_touch(a, b, p, q)) return true;
    }
  }
  return false;
}

bool holds(const std::vector<Vec2>& loop, const Vec2& point) {
  bool inside = false;
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const Vec2 &a = loop[k], &b = loop[(k + 1) % loop.size()];
    if ((a.y() > point.y()) == (b.y() > point.y())) continue;
    if (point.x() < a.x() + (point.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) inside = !inside;
  }
  return inside;
}

/// A vertex of a loop; several loops may have it, along a cut.
struct Seat {
  std::size_t loop, index;
};

std::vector<Seat> seats_of(const Loops& loops, int vertex, const Vec2& towards) {
  std::vector<Seat> out;
  for (std::size_t l = 0; l < loops.size(); ++l) {
    for (std::size_t k = 0; k < loops[l].vertices.size(); ++k) {
      if (loops[l].vertices[k] == vertex && leads_inside(loops[l].at, static_cast<int>(k), towards)) out.push_back({l, k});
    }
  }
  return out;
}

/// From one vertex of a loop on to another, both included; all around and to itself again where they are one.
void append_way(const OutlineLoop& loop, std::size_t from, std::size_t to, OutlineLoop& out) {
  const std::size_t n = loop.vertices.size();
  const std::size_t count = to > from ? to - from : to + n - from;
  for (std::size_t k = 0; k <= count; ++k) {
    const std::size_t v = (from + k) % n;
    out.vertices.push_back(loop.vertices[v]);
    out.at.push_back(loop.at[v]);
    if (!loop.shape.empty()) out.shape.push_back(loop.shape[v]);
  }
}

void divide(Loops& loops, const Seat& a, const Seat& b) {
  OutlineLoop first, second;
  append_way(loops[a.loop], a.index, a.loop == b.loop ? b.index : a.index, first);
  append_way(loops[b.loop], b.index, a.loop == b.loop ? a.index : b.index, a.loop == b.loop ? second : first);
  loops[a.loop] = std::move(first);
  if (a.loop == b.loop)
    loops.push_back(std::move(second));
  else
    loops.erase(loops.begin() + static_cast<std::ptrdiff_t>(b.loop));
}

/// Pieces to be packed.
struct Pieces {
  std::vector<Outline> outlines;
  std::vector<double> areas;
  double bent = 0;  ///< what those have lost that cannot be as they came
};

/// Adds those that the loops of one chart are the borders of.
void append_pieces(const Loops& loops, const std::vector<Loss>& bent, double spacing, Pieces& out) {
  for (const OutlineLoop& loop : loops) {
    if (area_of(loop.at) <= 0) continue;
    std::vector<const OutlineLoop*> own = {&loop};
    for (const OutlineLoop& hole : loops) {
      if (area_of(hole.at) <= 0 && holds(loop.at, hole.at.front())) own.push_back(&hole);
    }
    Outline& outline = out.outlines.emplace_back();
    double& area = out.areas.emplace_back(0);
    const std::vector<Vec2> outer = thinned(loop.shape, spacing), cut = thinned(loop.at, spacing);
    const bool has_shape = !loop.shape.empty() && area_of(outer) > 0 && !crosses_itself(outer);
    for (const OutlineLoop* part : own) {
      outline.loops.push_back(thinned(has_shape ? part->shape : part->at, spacing));
      area += area_of(outline.loops.back());
    }
    for (const Loss& loss : bent) out.bent += !has_shape && holds(cut, loss.at) ? loss.amount : 0;
  }
}

}  // namespace

CutOutlines::CutOutlines(const RefineOptions& options, const std::vector<ChartCuts>& charts, const ShapesAsTheyCame& shapes)
    : options_(options), shapes_(shapes) {
  for (std::size_t c = 0; c < charts.size(); ++c) charts_.push_back(loops_of(static_cast<int>(c), charts[c]));
}

Loops CutOutlines::loops_of(int chart, const ChartCuts& cuts) const {
  const Border border = cuts.border();
  const std::vector<Vec2>& shape = shapes_.uvs[chart];
  Loops out;
  for (std::size_t l = 0; l < border.loops.size(); ++l) {
    OutlineLoop& loop = out.emplace_back(OutlineLoop{border.loops[l], border.at[l], {}});
    for (const int v : loop.vertices) {
      if (!shape.empty()) loop.shape.push_back(value_at(cuts.support_of(v), shape));
    }
  }
  return out;
}

double CutOutlines::strain(const std::vector<Loops>& charts) const {
  double all = 0;
  for (const Loops& loops : charts) {
    for (const OutlineLoop& loop : loops) all += area_of(loop.at);
  }
  Pieces pieces;
  for (std::size_t c = 0; c < charts.size(); ++c) append_pieces(charts[c], shapes_.bent[c], kSpacing * std::sqrt(all), pieces);
  for (Outline& outline : pieces.outlines) outline.rotate = options_.rotate;
  const PackOptions pack{.gap = options_.gap.value_or(Gap{}).length(sides_of_area(all / kLikelyPe, options_.box_aspect)),
                         .box_aspect = options_.box_aspect,
                         .target_pe = options_.pe_bound,
                         .seed = options_.seed,
                         .threads = 1,
                         .search = PackSearch::Rough};
  const double pe = pack_charts(pieces.outlines, pieces.areas, pack).pe;
  return kBoxPrice * std::max(0.0, options_.pe_bound / pe - 1) + std::max(0.0, pieces.bent);
}

std::optional<double> CutOutlines::strain_with(const CutPlace& cut) const {
  std::vector<Loops> charts = charts_;
  Loops& loops = charts[cut.chart];
  const std::vector<Seat> from = seats_of(loops, cut.chord.ends[0], cut.chord.at[1]);
  const std::vector<Seat> to = seats_of(loops, cut.chord.ends[1], cut.chord.at[0]);
  for (const Seat& a : from) {
    for (const Seat& b : to) {
      // Only on one piece can both be parts of one border, or of an outer one and a hole's.
      if (a.loop != b.loop && (area_of(loops[a.loop].at) > 0) == (area_of(loops[b.loop].at) > 0)) continue;
      divide(loops, a, b);
      return strain(charts);
    }
  }
  return std::nullopt;
}

double CutOutlines::strain_with(int chart, const ChartCuts& cuts) const {
  std::vector<Loops> charts = charts_;
  charts[chart] = loops_of(chart, cuts);
  return strain(charts);
}

}  // namespace atlas_refine
