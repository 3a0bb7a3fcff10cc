// Stage 2 of the paper: which cuts, and where the pieces go (section 3.2, eq. 11).
#pragma once

#include <vector>

#include "atlas_refine/options.h"
#include "cut/side_prices.h"
#include "geometry/axis_aligned_chart.h"
#include "layout/axis_trails.h"
#include "support/monitor.h"

namespace atlas_refine {

/// A piece and where it goes. A piece is a union of rectangles of one chart; in the paper's layouts it is one rectangle.
struct PlacedPiece {
  int chart;
  Box box;            ///< in the chart's coordinates
  bool quarter_turn;  ///< counterclockwise, before it is moved
  Vec2 position;      ///< of the min corner, then
};

/// Cuts and placements.
struct Layout {
  std::vector<std::vector<TrailStart>> trails;  ///< per chart, in the order they are driven; each stops at the boundary or at an
                                                ///< earlier one
  std::vector<PlacedPiece> pieces;
  Vec2 box = Vec2::Zero();
  double pe = 0;          ///< of the charts in the box
  double growth = 0;      ///< of the boundary, as a fraction of that of the axis-aligned charts
  Gap gap;                ///< kept between pieces
  int extra_corners = 0;  ///< added per chart beyond its own because the bound was missed
};

struct LayoutOptions {
  double pe_bound = 0.8;
  double box_aspect = 0;
  std::vector<Gap> gaps;  ///< to be tried in this order
  RectangleOptions rectangles;
  std::uint64_t seed = 1;
  int threads = 1;
  std::vector<SidePrices> prices = {};  ///< one per chart: trails keep off edges at kNoSeam where they can; empty: no such edges
};

/// The best of options.rectangles.candidates layouts by eq. (11) among those at the bound. Where none holds it: smaller gaps,
/// then extra corners; at last the layout of the highest PE. After it others that hold the bound by other cuts: which
/// of them leaves the least distortion is known only once pieces are reduced. `sources` are the charts that `aligned` were made
/// from.
std::vector<Layout> search_layouts(const std::vector<AxisAlignedChart>& aligned, const std::vector<Chart>& sources,
                                   const LayoutOptions& options, Monitor& monitor);

/// The same pieces packed in up to `ways` other ways that hold the bound.
std::vector<Layout> packed_otherwise(const Layout& layout, int ways, const LayoutOptions& options);

}  // namespace atlas_refine
