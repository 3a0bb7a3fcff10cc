// The strip that is filled from below: which cells are taken, and where a
// raster fits lowest.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "pack/free_squares.h"
#include "pack/raster.h"

namespace atlas_refine {

/// A bitmap of fixed width that grows upward. For every row it also keeps the
/// cells from which a run of 2^k free cells starts, so that testing a run of
/// any length costs two lookups for 64 positions at once.
class Occupancy {
 public:
  /// `many`: with an index of free squares, which pays where hundreds of rasters are to come.
  explicit Occupancy(int width, bool many = false);

  int height() const { return height_; }       ///< rows up to the topmost taken cell
  std::int64_t work() const { return work_; }  ///< words looked at so far

  /// Lowest, then leftmost place of the raster with lowest <= y <= highest;
  /// false where there is none.
  bool find_lowest(const Raster& raster, int highest, Cell& place, int lowest = 0);
  void add(const Raster& raster, const Cell& place);

 private:
  std::uint64_t* level_row(int y, int level) { return taken_.data() + (static_cast<size_t>(y) * levels_ + level) * words_; }
  void grow(int rows);
  int longest_free_run(int y);
  /// The x in [64 word, 64 word + 64) at which the raster placed at height y
  /// hits a taken cell.
  std::uint64_t blocked_word(const Raster& raster, const std::vector<int>& order, int y, int word);

  int width_;
  int height_ = 0;
  int words_;
  int levels_;
  std::int64_t work_ = 0;
  std::vector<std::uint64_t> taken_;  ///< [row][level]: bit x set where some
                                      ///< cell of [x, x + 2^level) is taken
  std::vector<int> longest_free_;     ///< of each row, in cells
  std::optional<FreeSquares> squares_;
};

}  // namespace atlas_refine
