// Conservative bitmaps of turned outlines, dilated by half the gap: disjoint
// bitmaps mean a distance of at least the gap.
#pragma once

#include <cstdint>
#include <vector>

#include "pack/turns.h"

namespace atlas_refine {

/// Cells [begin, end) of one row.
struct Run {
  int row;
  int begin;
  int end;
};

/// Every cell that a turned and dilated outline touches. Cell (0, 0) has its
/// min corner at `origin`, in the turned frame.
struct Raster {
  Turn turn;
  Vec2 origin = Vec2::Zero();
  int width = 0;  ///< cells
  int height = 0;
  int words = 0;                    ///< 64-bit words per row
  int cells = 0;                    ///< set cells
  std::vector<std::uint64_t> bits;  ///< row by row; an empty word before the first row and after each
  std::vector<Run> runs;            ///< the same, ascending by row, then begin

  int stride() const { return words + 1; }
  const std::uint64_t* row(int y) const { return bits.data() + 1 + static_cast<size_t>(y) * stride(); }
};

/// The outline turned, dilated by `radius` and covered with cells of side
/// `cell`.
Raster rasterise(const Outline& outline, const Turn& turn, double radius, double cell);

/// A rectangle of cells of side `cell`; cell (0, 0) has its min corner at `corner`.
struct Window {
  double cell;
  Vec2 corner;
  int width, height;  ///< cells
};

/// The window's cells that the outline touches when it is dilated by `radius`; it may lie anywhere and be of any size.
Raster rasterise_in(const Window& window, const Outline& outline, double radius);

struct Cell {
  int x = 0;
  int y = 0;

  bool operator==(const Cell&) const = default;
};

/// Number of cells that two rasters share when their cells (0, 0) lie at the
/// given places.
int shared_cells(const Raster& a, const Cell& a_place, const Raster& b, const Cell& b_place);

}  // namespace atlas_refine
