// A square is free where four smaller ones that cover it are.
#include "pack/free_squares.h"

#include <algorithm>
#include <bit>

#include "pack/row_bits.h"

namespace atlas_refine {
namespace {

// Each at most twice the one before it, which then covers it four times. Larger charts are seldom, and several probes tell
// enough.
constexpr std::array kSides = {1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64};
constexpr std::uint64_t kAll = ~std::uint64_t{0};

int level_of(int side) { return static_cast<int>(std::upper_bound(kSides.begin(), kSides.end(), side) - kSides.begin()) - 1; }

bool is_set(const Raster& raster, int x, int y) { return raster.row(y)[x >> 6] >> (x & 63) & 1; }

}  // namespace

Probes probes_of(const Raster& raster) {
  struct Square {
    int side = 0, x = 0, y = 0;
  };
  std::array<Square, 3> best;
  const bool wide = raster.width >= raster.height;
  const int length = wide ? raster.width : raster.height;
  // The largest square with its min corner at x, from those to the right of it and above.
  std::vector<int> side(raster.width + 1, 0), above(raster.width + 1, 0);
  for (int y = raster.height - 1; y >= 0; --y) {
    std::swap(side, above);
    for (int x = raster.width - 1; x >= 0; --x) {
      side[x] = is_set(raster, x, y) ? 1 + std::min({side[x + 1], above[x], above[x + 1]}) : 0;
      const int middle = (wide ? x : y) + side[x] / 2;
      Square& largest = best[std::min(2, 3 * middle / length)];
      if (side[x] > largest.side) largest = {side[x], x, y};
    }
  }
  std::stable_sort(best.begin(), best.end(), [](const Square& a, const Square& b) { return a.side > b.side; });
  for (Square& square : best) {
    if (square.side == 0) square = best[0];
  }
  const auto probe = [](const Square& square, int inset) {
    return Probe{level_of(square.side), square.x + inset, square.y + inset};
  };
  const int rounded_off = best[0].side - kSides[level_of(best[0].side)];
  return {probe(best[0], 0), probe(best[0], rounded_off), probe(best[1], 0), probe(best[2], 0)};
}

FreeSquares::FreeSquares(int width)
    : width_(width), words_((width + 63) / 64), chunks_((words_ + 63) / 64), levels_(kSides.size()) {}

void FreeSquares::grow(int rows) {
  if (rows <= rows_) return;
  rows_ = rows * 3 / 2;
  for (Level& level : levels_) {
    level.hit.resize(static_cast<std::size_t>(rows_) * (words_ + 2), 0);
    level.full.resize(static_cast<std::size_t>(rows_) * (chunks_ + 2), 0);
  }
}

void FreeSquares::mark_full(Level& level, int row, int first_word, int last_word) {
  const std::uint64_t* hit = level.hit.data() + static_cast<std::size_t>(row) * (words_ + 2);
  std::uint64_t* full = level.full.data() + static_cast<std::size_t>(row) * (chunks_ + 2);
  for (int word = first_word; word <= last_word; ++word) {
    if (hit[word] == kAll) full[word >> 6] |= std::uint64_t{1} << (word & 63);
  }
}

void FreeSquares::take(const Raster& raster, const Cell& place) {
  Level& level = levels_[0];
  for (const Run& run : raster.runs) {
    std::uint64_t* row = level.hit.data() + static_cast<std::size_t>(place.y + run.row) * (words_ + 2);
    for (int x = place.x + run.begin; x < place.x + run.end; ++x) row[x >> 6] |= std::uint64_t{1} << (x & 63);
    mark_full(level, place.y + run.row, (place.x + run.begin) >> 6, (place.x + run.end - 1) >> 6);
  }
}

void FreeSquares::update(std::size_t level, int first_row, int last_row, int first_word, int last_word) {
  const int offset = kSides[level] - kSides[level - 1];
  const std::size_t stride = words_ + 2;
  for (int y = first_row; y <= last_row; ++y) {
    const std::uint64_t* low = levels_[level - 1].hit.data() + y * stride;
    const std::uint64_t* high = low + offset * stride;
    std::uint64_t* row = levels_[level].hit.data() + y * stride;
    for (int word = first_word; word <= last_word; ++word) {
      const int right = word * 64 + offset;
      row[word] = low[word] | high[word] | bits_from(low, right) | bits_from(high, right);
    }
    mark_full(levels_[level], y, first_word, last_word);
  }
}

void FreeSquares::add(const Raster& raster, const Cell& place) {
  grow(place.y + raster.height + kSides.back());
  take(raster, place);
  for (std::size_t level = 1; level < levels_.size(); ++level) {
    const int reach = kSides[level] - 1;
    update(level, std::max(0, place.y - reach), place.y + raster.height - 1, std::max(0, place.x - reach) >> 6,
           (place.x + raster.width - 1) >> 6);
  }
}

/// Of 64 words of positions those in which the probe does not hit everywhere; rows above all that is taken are open.
std::uint64_t FreeSquares::open_words(const Probe& probe, int y, int chunk) const {
  if (y + probe.y >= rows_) return kAll;
  const std::uint64_t* full = levels_[probe.level].full.data() + static_cast<std::size_t>(y + probe.y) * (chunks_ + 2);
  const int first = chunk * 64 + (probe.x >> 6);
  if (first >= words_) return 0;
  const std::uint64_t here = bits_from(full, first);
  return (probe.x & 63) == 0 ? ~here : ~(here & bits_from(full, first + 1));
}

int FreeSquares::next_word(const Probes& probes, int y, int word) const {
  for (int chunk = word >> 6; chunk < chunks_; ++chunk) {
    std::uint64_t open = chunk == word >> 6 ? kAll << (word & 63) : kAll;
    for (const Probe& probe : probes) {
      if (open == 0) break;
      open &= open_words(probe, y, chunk);
    }
    if (open != 0) return chunk * 64 + std::countr_zero(open);
  }
  return chunks_ * 64;
}

std::uint64_t FreeSquares::blocked(const Probes& probes, int y, int word) const {
  std::uint64_t blocked = 0;
  for (const Probe& probe : probes) {
    if (y + probe.y >= rows_ || blocked == kAll) continue;
    const std::uint64_t* hit = levels_[probe.level].hit.data() + static_cast<std::size_t>(y + probe.y) * (words_ + 2);
    blocked |= bits_from(hit, word * 64 + probe.x);
  }
  return blocked;
}

}  // namespace atlas_refine
