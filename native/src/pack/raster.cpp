// Conservative bitmaps: per row of cells, the exact extent of every dilated
// edge, and the inside between them.
#include "pack/raster.h"

#include <algorithm>
#include <cmath>

#include "pack/capsule.h"
#include "support/inline.h"

namespace atlas_refine {
namespace {

struct Interval {
  double low, high;
};

/// One row of cells: what the dilated edges cover of it, and where the outline crosses its middle.
struct Row {
  std::vector<Interval> covered;
  std::vector<std::pair<double, int>> crossings;  ///< x, and +1 where the outline goes down
};

/// Adds the edge from a to b, in cells, to those rows that its capsule reaches.
void add_edge(const Vec2& a, const Vec2& b, double radius, std::vector<Row>& rows) {
  const Capsule capsule{a, b, radius}, mirrored{{-a.x(), a.y()}, {-b.x(), b.y()}, radius};
  const double low = std::min(a.y(), b.y()), high = std::max(a.y(), b.y());
  const auto count = static_cast<double>(rows.size());
  if (high + radius < 0 || low - radius >= count) return;
  const int first = static_cast<int>(std::max(std::floor(low - radius), 0.0));
  const int last = static_cast<int>(std::min(std::floor(high + radius), count - 1));
  for (int y = first; y <= last; ++y) {
    rows[y].covered.push_back({-mirrored.right_in(y, y + 1), capsule.right_in(y, y + 1)});
    const double middle = y + 0.5;
    if ((a.y() > middle) == (b.y() > middle)) continue;
    rows[y].crossings.emplace_back(a.x() + (middle - a.y()) / (b.y() - a.y()) * (b.x() - a.x()), a.y() > b.y() ? 1 : -1);
  }
}

/// Adds what lies inside the outline along the middle of the row.
void add_inside(Row& row) {
  std::sort(row.crossings.begin(), row.crossings.end());
  int winding = 0;
  for (std::size_t k = 0; k + 1 < row.crossings.size(); ++k) {
    winding += row.crossings[k].second;
    if (winding != 0) row.covered.push_back({row.crossings[k].first, row.crossings[k + 1].first});
  }
}

/// Merges the row's intervals into runs of cells and sets their bits.
void add_row(Raster& raster, int y, std::vector<Interval>& intervals) {
  std::sort(intervals.begin(), intervals.end(), [](const Interval& p, const Interval& q) { return p.low < q.low; });
  const size_t first = raster.runs.size();
  const double width = raster.width;
  for (const Interval& interval : intervals) {
    if (interval.high < 0 || interval.low >= width) continue;
    const int begin = static_cast<int>(std::max(std::floor(interval.low), 0.0));
    const int end = std::max(begin + 1, static_cast<int>(std::min(std::floor(interval.high) + 1, width)));
    if (raster.runs.size() > first && begin <= raster.runs.back().end) {
      raster.runs.back().end = std::max(raster.runs.back().end, end);
    } else {
      raster.runs.push_back({y, begin, end});
    }
  }
  std::uint64_t* row = raster.bits.data() + 1 + static_cast<size_t>(y) * raster.stride();
  for (size_t k = first; k < raster.runs.size(); ++k) {
    for (int x = raster.runs[k].begin; x < raster.runs[k].end; ++x) row[x >> 6] |= std::uint64_t{1} << (x & 63);
    raster.cells += raster.runs[k].end - raster.runs[k].begin;
  }
}

/// Sets the raster's cells that the loops, given in cells, touch when they are dilated by `radius` cells.
void cover(Raster& raster, const std::vector<std::vector<Vec2>>& loops, double radius) {
  raster.words = (raster.width + 63) / 64;
  raster.bits.assign(static_cast<size_t>(raster.stride()) * raster.height + 1, 0);
  std::vector<Row> rows(raster.height);
  for (const auto& loop : loops) {
    for (size_t i = 0; i < loop.size(); ++i) add_edge(loop[i], loop[(i + 1) % loop.size()], radius, rows);
  }
  for (int y = 0; y < raster.height; ++y) {
    add_inside(rows[y]);
    add_row(raster, y, rows[y].covered);
  }
}

// Widened by what round-off may lose, so that "touches" is never missed.
constexpr double kSlack = 1e-7;  // cells

/// The cells that two rasters may share.
struct Shared {
  const Raster &a, &b;
  Cell a_place, b_place;
  int bottom = 0, top = 0, left = 0, right = 0;
};

/// std::popcount calls a table look-up where the processor's own instruction may not be assumed; this takes half its time.
template <bool HasInstruction>
ATLAS_REFINE_INLINE int set_bits(std::uint64_t word) {
  if constexpr (HasInstruction) return __builtin_popcountll(word);
  word -= word >> 1 & 0x5555555555555555;
  word = (word & 0x3333333333333333) + (word >> 2 & 0x3333333333333333);
  word = (word + (word >> 4)) & 0x0f0f0f0f0f0f0f0f;
  return static_cast<int>(word * 0x0101010101010101 >> 56);
}

template <bool HasInstruction>
ATLAS_REFINE_INLINE int count(const Shared& in) {
  int count = 0;
  for (int word = (in.left - in.a_place.x) >> 6; word <= (in.right - 1 - in.a_place.x) >> 6; ++word) {
    // The word's 64 cells begin at `at` in b; b's guard words make both reads safe.
    const int at = word * 64 + in.a_place.x - in.b_place.x;
    const int b_word = at >> 6, shift = at & 63;
    const std::uint64_t* a_row = in.a.row(in.bottom - in.a_place.y) + word;
    const std::uint64_t* b_row = in.b.row(in.bottom - in.b_place.y) + b_word;
    const int a_stride = in.a.stride(), b_stride = in.b.stride();
    if (shift == 0) {
      for (int y = in.bottom; y < in.top; ++y, a_row += a_stride, b_row += b_stride)
        count += set_bits<HasInstruction>(*a_row & *b_row);
    } else {
      for (int y = in.bottom; y < in.top; ++y, a_row += a_stride, b_row += b_stride)
        count += set_bits<HasInstruction>(*a_row & ((b_row[0] >> shift) | (b_row[1] << (64 - shift))));
    }
  }
  return count;
}

int count_baseline(const Shared& in) { return count<false>(in); }
#ifdef __x86_64__
__attribute__((target("popcnt"))) int count_popcnt(const Shared& in) { return count<true>(in); }
#endif

/// The same count with what this processor has.
auto fastest_count() {
#ifdef __x86_64__
  if (__builtin_cpu_supports("popcnt")) return count_popcnt;
#endif
  return count_baseline;
}

}  // namespace

Raster rasterise(const Outline& outline, const Turn& turn, double radius, double cell) {
  std::vector<std::vector<Vec2>> loops = outline.loops;
  Box box{Vec2::Constant(INFINITY), Vec2::Constant(-INFINITY)};
  for (auto& loop : loops) {
    for (Vec2& p : loop) {
      p = turn.apply(p);
      box.min = box.min.cwiseMin(p);
      box.max = box.max.cwiseMax(p);
    }
  }
  Raster raster;
  raster.turn = turn;
  const double r = radius / cell + kSlack;
  raster.origin = box.min - Vec2::Constant(r * cell);
  raster.width = static_cast<int>(std::floor(box.size().x() / cell + 2 * r)) + 1;
  raster.height = static_cast<int>(std::floor(box.size().y() / cell + 2 * r)) + 1;
  for (auto& loop : loops) {
    for (Vec2& p : loop) p = (p - raster.origin) / cell;
  }
  cover(raster, loops, r);
  return raster;
}

Raster rasterise_in(const Window& window, const Outline& outline, double radius) {
  std::vector<std::vector<Vec2>> loops = outline.loops;
  double farthest = 0;
  for (auto& loop : loops) {
    for (Vec2& p : loop) {
      p = (p - window.corner) / window.cell;
      farthest = std::max(farthest, p.cwiseAbs().maxCoeff());
    }
  }
  Raster raster;
  raster.origin = window.corner;
  raster.width = window.width;
  raster.height = window.height;
  // Where an edge with far ends passes the window is known to no more than round-off of its ends.
  cover(raster, loops, radius / window.cell + std::max(kSlack, 1e-14 * farthest));
  return raster;
}

int shared_cells(const Raster& a, const Cell& a_place, const Raster& b, const Cell& b_place) {
  static const auto counted = fastest_count();
  if (a.words > b.words) return shared_cells(b, b_place, a, a_place);
  Shared shared{a, b, a_place, b_place};
  shared.bottom = std::max(a_place.y, b_place.y), shared.top = std::min(a_place.y + a.height, b_place.y + b.height);
  shared.left = std::max(a_place.x, b_place.x), shared.right = std::min(a_place.x + a.width, b_place.x + b.width);
  return shared.bottom < shared.top && shared.left < shared.right ? counted(shared) : 0;
}

}  // namespace atlas_refine
