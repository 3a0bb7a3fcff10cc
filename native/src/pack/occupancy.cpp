// Bottom-left search on bitmaps, 64 positions at a time.
#include "pack/occupancy.h"

#include <algorithm>
#include <bit>
#include <numeric>

namespace atlas_refine {
namespace {

/// 64 bits of a row from bit `at` on; the row has a spare word at its end.
std::uint64_t bits_from(const std::uint64_t* row, int at) {
  const int word = at >> 6, shift = at & 63;
  return shift == 0 ? row[word] : (row[word] >> shift) | (row[word + 1] << (64 - shift));
}

}  // namespace

Occupancy::Occupancy(int width) : width_(width), words_(width / 64 + 2), levels_(std::bit_width(static_cast<unsigned>(width))) {}

void Occupancy::grow(int rows) {
  const size_t size = static_cast<size_t>(rows) * levels_ * words_;
  if (taken_.size() < size) taken_.resize(size * 3 / 2, 0);
}

void Occupancy::add(const Raster& raster, const Cell& place) {
  grow(place.y + raster.height);
  height_ = std::max(height_, place.y + raster.height);
  for (const Run& run : raster.runs) {
    std::uint64_t* row = level_row(place.y + run.row, 0);
    for (int x = place.x + run.begin; x < place.x + run.end; ++x) row[x >> 6] |= std::uint64_t{1} << (x & 63);
  }
  for (int y = place.y; y < place.y + raster.height; ++y) {
    for (int level = 1; level < levels_; ++level) {
      const std::uint64_t* below = level_row(y, level - 1);
      std::uint64_t* row = level_row(y, level);
      const int step = 1 << (level - 1);
      for (int word = 0; word < words_; ++word) {
        const int at = word * 64 + step;
        const std::uint64_t shifted = (at >> 6) + 1 < words_ ? bits_from(below, at) : 0;
        row[word] = below[word] | shifted;
      }
    }
  }
}

bool Occupancy::free_positions(const Raster& raster, const std::vector<int>& order, int y, int positions) {
  const int words = (positions + 63) / 64;
  std::fill_n(blocked_.begin(), words, 0);
  if (positions & 63) blocked_[words - 1] = ~std::uint64_t{0} << (positions & 63);
  for (const int k : order) {
    const Run& run = raster.runs[k];
    if (y + run.row >= height_) continue;
    const int level = std::bit_width(static_cast<unsigned>(run.end - run.begin)) - 1;
    const std::uint64_t* row = level_row(y + run.row, level);
    const int first = run.begin, second = run.end - (1 << level);
    std::uint64_t all = ~std::uint64_t{0};
    for (int word = 0; word < words; ++word) {
      blocked_[word] |= bits_from(row, word * 64 + first) | bits_from(row, word * 64 + second);
      all &= blocked_[word];
    }
    if (all == ~std::uint64_t{0}) return false;
  }
  return true;
}

bool Occupancy::find_lowest(const Raster& raster, int highest, Cell& place) {
  const int positions = width_ - raster.width + 1;
  if (positions <= 0) return false;
  blocked_.resize(words_);
  // Long runs first: they block most.
  std::vector<int> order(raster.runs.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int p, int q) {
    const int a = raster.runs[p].end - raster.runs[p].begin, b = raster.runs[q].end - raster.runs[q].begin;
    return a != b ? a > b : p < q;
  });
  for (int y = 0; y <= std::min(highest, height_); ++y) {
    if (!free_positions(raster, order, y, positions)) continue;
    for (int word = 0;; ++word) {
      if (~blocked_[word] == 0) continue;
      place = {word * 64 + std::countr_one(blocked_[word]), y};
      return true;
    }
  }
  return false;
}

}  // namespace atlas_refine
