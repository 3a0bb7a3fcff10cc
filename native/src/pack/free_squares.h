// Where squares of several sizes are free in the strip: thousands of charts are searched a place only where their largest
// squares fit.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "pack/raster.h"

namespace atlas_refine {

/// Squares that lie in a raster and tell early where it does not fit.
struct Probe {
  int level;  ///< of FreeSquares
  int x, y;   ///< its min corner in the raster, cells
};

using Probes = std::array<Probe, 4>;

/// Of a raster the largest in each third of its longer side. Sides are rounded down to a level's: the largest of all is told by
/// two, from its min and its max corner.
Probes probes_of(const Raster& raster);

/// For each of some sides a bitmap of the strip: bit x of row y is set where the square with that min corner hits a taken cell.
/// Words of which all bits are set are marked, so that 4096 positions are passed over at once.
class FreeSquares {
 public:
  explicit FreeSquares(int width);

  void add(const Raster& raster, const Cell& place);

  /// The next word from `word` on in which one of the probes' 64 positions may be free in row `y`; `words_` where there is none.
  int next_word(const Probes& probes, int y, int word) const;
  /// The positions of that word at which some probe hits a taken cell.
  std::uint64_t blocked(const Probes& probes, int y, int word) const;

 private:
  struct Level {
    std::vector<std::uint64_t> hit;   ///< row by row, each with a spare word at its end
    std::vector<std::uint64_t> full;  ///< a bit for each word of a row, likewise
  };

  void grow(int rows);
  void take(const Raster& raster, const Cell& place);
  void update(std::size_t level, int first_row, int last_row, int first_word, int last_word);
  void mark_full(Level& level, int row, int first_word, int last_word);
  std::uint64_t open_words(const Probe& probe, int y, int chunk) const;

  int width_;
  int words_;   ///< of a row
  int chunks_;  ///< 64 words each
  int rows_ = 0;
  std::vector<Level> levels_;
};

}  // namespace atlas_refine
