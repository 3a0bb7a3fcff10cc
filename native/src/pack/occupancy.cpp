// Bottom-left search on bitmaps, 64 positions at a time.
#include "pack/occupancy.h"

#include <algorithm>
#include <bit>

#include "pack/row_bits.h"

namespace atlas_refine {

Occupancy::Occupancy(int width, bool many)
    : width_(width), words_(width / 64 + 2), levels_(std::bit_width(static_cast<unsigned>(width))) {
  if (many) squares_.emplace(width);
}

void Occupancy::grow(int rows) {
  const size_t size = static_cast<size_t>(rows) * levels_ * words_;
  if (taken_.size() < size) taken_.resize(size * 3 / 2, 0);
  if (static_cast<int>(longest_free_.size()) < rows) longest_free_.resize(rows, width_);
}

int Occupancy::longest_free_run(int y) {
  const std::uint64_t* row = level_row(y, 0);
  int longest = 0;
  for (int x = 0; x < width_;) {
    // To the next free cell, then to the next taken one.
    const std::uint64_t free = ~bits_from(row, x);
    if (free == 0) {
      x += 64;
      continue;
    }
    const int begin = x + std::countr_zero(free);
    for (x = begin; x < width_;) {
      const std::uint64_t taken = bits_from(row, x);
      x += taken == 0 ? 64 : std::countr_zero(taken);
      if (taken != 0) break;
    }
    longest = std::max(longest, std::min(x, width_) - begin);
  }
  return longest;
}

void Occupancy::add(const Raster& raster, const Cell& place) {
  grow(place.y + raster.height);
  height_ = std::max(height_, place.y + raster.height);
  if (squares_) squares_->add(raster, place);
  for (const Run& run : raster.runs) {
    std::uint64_t* row = level_row(place.y + run.row, 0);
    for (int x = place.x + run.begin; x < place.x + run.end; ++x) row[x >> 6] |= std::uint64_t{1} << (x & 63);
  }
  for (int y = place.y; y < place.y + raster.height; ++y) {
    longest_free_[y] = longest_free_run(y);
    for (int level = 1; level < levels_; ++level) {
      const std::uint64_t* below = level_row(y, level - 1);
      std::uint64_t* row = level_row(y, level);
      const int step = 1 << (level - 1);
      // Only runs that start less than their length before the raster, or in it, have changed.
      const int first = std::max(0, place.x - 2 * step + 1) >> 6, last = (place.x + raster.width - 1) >> 6;
      work_ += last - first + 1;
      for (int word = first; word <= last; ++word) {
        const int at = word * 64 + step;
        const std::uint64_t shifted = (at >> 6) + 1 < words_ ? bits_from(below, at) : 0;
        row[word] = below[word] | shifted;
      }
    }
  }
}

std::uint64_t Occupancy::blocked_word(const Raster& raster, const std::vector<int>& order, int y, int word) {
  std::uint64_t blocked = 0;
  for (const int k : order) {
    const Run& run = raster.runs[k];
    ++work_;
    if (y + run.row >= height_) continue;
    const int level = std::bit_width(static_cast<unsigned>(run.end - run.begin)) - 1;
    const std::uint64_t* row = level_row(y + run.row, level);
    blocked |= bits_from(row, word * 64 + run.begin) | bits_from(row, word * 64 + run.end - (1 << level));
    if (blocked == ~std::uint64_t{0}) break;
  }
  return blocked;
}

bool Occupancy::find_lowest(const Raster& raster, int highest, Cell& place, int lowest) {
  const int positions = width_ - raster.width + 1;
  if (positions <= 0) return false;
  // The longest run first, then runs spread over all heights: each is likely to
  // block what those before it did not.
  const int count = static_cast<int>(raster.runs.size());
  std::vector<int> order;
  const auto length = [&](int k) { return raster.runs[k].end - raster.runs[k].begin; };
  for (int k = 0, longest_run = 0; k < count; ++k) {
    if (length(k) > length(longest_run)) longest_run = k;
    if (k + 1 == count) order.push_back(longest_run);
  }
  const int bits = std::bit_width(static_cast<unsigned>(count - 1));
  for (unsigned k = 0; k < 1u << bits; ++k) {
    unsigned reversed = 0;
    for (int bit = 0; bit < bits; ++bit) reversed |= (k >> bit & 1) << (bits - 1 - bit);
    if (static_cast<int>(reversed) < count) order.push_back(reversed);
  }
  const auto probes = squares_ ? probes_of(raster) : Probes{};
  const auto next_word = [&](int word, int y) {
    if (!squares_) return word;
    ++work_;
    return squares_->next_word(probes, y, word);
  };
  const int longest_row = raster.runs[order[0]].row, longest = length(order[0]);
  for (int y = lowest; y <= std::min(highest, std::max(height_, lowest)); ++y) {
    if (y + longest_row < height_ && longest_free_[y + longest_row] < longest) continue;
    for (int word = next_word(0, y); word * 64 < positions; word = next_word(word + 1, y)) {
      std::uint64_t blocked = squares_ ? squares_->blocked(probes, y, word) : 0;
      if (positions - word * 64 < 64) blocked |= ~std::uint64_t{0} << (positions - word * 64);
      if (blocked != ~std::uint64_t{0}) blocked |= blocked_word(raster, order, y, word);
      if (blocked == ~std::uint64_t{0}) continue;
      place = {word * 64 + std::countr_one(blocked), y};
      return true;
    }
  }
  return false;
}

}  // namespace atlas_refine
