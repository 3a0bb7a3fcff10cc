// The turn of the smallest box; of turns that are equally good, and of starts of a loop, the one whose digits come first.
#include "pack/canonical_outlines.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "measure/distortion.h"
#include "pack/turns.h"

namespace atlas_refine {
namespace {

// The grid's cell as a fraction of an outline's extent: far above the rounding of UVs that lie a thousand boxes off, and far
// below what is kept beyond the gap.
constexpr double kCell = 0x1p-28;
// Boxes whose areas differ by less are equally small: all of an acute triangle are.
constexpr double kEquallySmall = 1e-9;
constexpr std::size_t kMostTurns = 16;  // of equally small boxes; more are had by regular polygons alone, where all are one

using Loop = std::vector<Vec2>;

bool comes_before(const Vec2& a, const Vec2& b) { return std::tie(a.y(), a.x()) < std::tie(b.y(), b.x()); }

bool comes_before(const Loop& a, const Loop& b) {
  return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end(),
                                      [](const Vec2& p, const Vec2& q) { return comes_before(p, q); });
}

/// Points of no distance are one.
Loop on_grid(const Loop& loop, const Placement& motion, double unit, double cell) {
  Loop out;
  for (const Vec2& p : loop) {
    const Vec2 place = motion.apply(p) / unit / cell;
    const Vec2 q = cell * Vec2(std::round(place.x()), std::round(place.y()));
    if (out.empty() || q != out.back()) out.push_back(q);
  }
  while (out.size() > 1 && out.back() == out.front()) out.pop_back();
  std::rotate(out.begin(),
              std::min_element(out.begin(), out.end(), [](const Vec2& a, const Vec2& b) { return comes_before(a, b); }),
              out.end());
  return out;
}

struct Told {
  Outline outline;
  Placement motion;
  double size = 0;  // area of its box
  double cell = 0;
};

/// In single precision: what the same points in another order give agrees.
double rounded(double value) { return static_cast<double>(static_cast<float>(value)); }

Told told_in_turn(const Outline& outline, const std::vector<Vec2>& hull, const Turn& turn, double unit) {
  const Box box = turned_box(hull, turn);
  Told out{.outline = {{}, outline.rotate},
           .motion = {turn.cosine, turn.sine, -box.min},
           .size = rounded(box.area() / (unit * unit)),
           .cell = kCell * rounded(box.diagonal() / unit)};
  std::vector<Loop>& loops = out.outline.loops;
  for (const Loop& loop : outline.loops)
    loops.push_back(out.cell > 0 ? on_grid(loop, out.motion, unit, out.cell) : Loop(1, Vec2::Zero()));
  std::sort(loops.begin() + 1, loops.end(), [](const Loop& a, const Loop& b) { return comes_before(a, b); });
  return out;
}

bool comes_before(const Outline& a, const Outline& b) {
  return std::lexicographical_compare(a.loops.begin(), a.loops.end(), b.loops.begin(), b.loops.end(),
                                      [](const Loop& p, const Loop& q) { return comes_before(p, q); });
}

std::vector<Turn> candidate_turns(const Outline& outline, const std::vector<Vec2>& hull) {
  std::vector<Turn> turns = {{}};
  if (outline.rotate == Rotate::None) return turns;
  if (outline.rotate == Rotate::Any) turns = smallest_box_turns(hull, kEquallySmall, kMostTurns);
  std::vector<Turn> all;
  for (Turn turn : turns) {
    for (int quarter = 0; quarter < 4; ++quarter, turn = turn.quarter_turned()) all.push_back(turn);
  }
  return all;
}

Told told(const Outline& outline, double unit) {
  const std::vector<Vec2> hull = convex_hull(outline);
  const std::vector<Turn> turns = candidate_turns(outline, hull);
  Told best = told_in_turn(outline, hull, turns.front(), unit);
  for (std::size_t k = 1; k < turns.size(); ++k) {
    Told other = told_in_turn(outline, hull, turns[k], unit);
    if (comes_before(other.outline, best.outline)) best = std::move(other);
  }
  return best;
}

}  // namespace

CanonicalOutlines canonical_outlines(const std::vector<Outline>& outlines, double unit) {
  std::vector<Told> all;
  for (const Outline& outline : outlines) all.push_back(told(outline, unit));
  CanonicalOutlines out{.sources = std::vector<int>(outlines.size()), .unit = unit};
  std::iota(out.sources.begin(), out.sources.end(), 0);
  std::stable_sort(out.sources.begin(), out.sources.end(), [&](int a, int b) {
    if (all[a].size != all[b].size) return all[a].size > all[b].size;
    return comes_before(all[a].outline, all[b].outline);
  });
  for (const int source : out.sources) {
    out.off_grid = std::max(out.off_grid, all[source].cell);  // its half diagonal, and rounding
    out.motions.push_back(all[source].motion);
    out.outlines.push_back(std::move(all[source].outline));
  }
  return out;
}

std::vector<Placement> CanonicalOutlines::of_input(const std::vector<Placement>& placements) const {
  std::vector<Placement> out(placements.size());
  for (std::size_t k = 0; k < placements.size(); ++k) {
    const Placement &first = motions[k], &then = placements[k];
    const Turn turn{then.cosine, then.sine}, both = turn.after({first.cosine, first.sine});
    out[sources[k]] = {both.cosine, both.sine, turn.apply(first.offset) + unit * then.offset};
  }
  return out;
}

}  // namespace atlas_refine
