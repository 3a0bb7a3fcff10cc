// Every chart made valid by itself, changed only where it must be, the least change first.
#pragma once

#include <string>
#include <vector>

#include "cut/cut_atlas.h"
#include "cut/side_prices.h"
#include "geometry/freedom.h"
#include "support/monitor.h"

namespace atlas_refine {

struct RepairOptions {
  /// Per vertex of each chart: the point in space where it lies. With it borders of a chart that touch at such a point alone (a
  /// pinch) are left as they are.
  const std::vector<std::vector<int>>* space_points = nullptr;
  Freedoms freedom = {};     ///< per chart: fixed ones are left alone, those that only move are not mended
  bool may_overlap = false;  ///< positive triangles are enough, and disks with holes: the charts are going to be deformed
  bool open_closed = false;  ///< charts without a boundary, or with a handle, may be opened along edges of their faces
  std::vector<SidePrices> prices = {};  ///< per chart what seams cost there; empty: the same everywhere
  int threads = 1;
};

/// What was done to one chart.
struct ChartRepair {
  enum class What {
    Parted,      ///< touched itself: touching vertices were drawn apart
    Untangled,   ///< flipped, zero-area or crushed faces were turned in place
    DrawnApart,  ///< overlapped itself: embedded with the shapes of its UVs
    Embedded,    ///< overlapped itself: embedded anew
    Opened,      ///< had no boundary, or a handle: opened along edges and embedded
  };
  int chart;
  What what;
  std::vector<int> faces = {};     ///< of the input, that were flipped or had next to no area
  double distortion_to_input = 0;  ///< E_2 to the input's UVs over all other faces; 0 where there are none
};

/// A chart that could not be mended, and is as it was.
struct UnmendedChart {
  int chart;
  int face;            ///< of the input, where one is to blame; else the chart's first
  std::string reason;  ///< continues "chart 3 "
};

struct RepairedCharts {
  CutAtlas atlas;  ///< one piece per chart, in their order; seams where charts were opened
  std::vector<ChartRepair> repairs;
  std::vector<UnmendedChart> unmended;
};

RepairedCharts repair_charts(const std::vector<Chart>& charts, const RepairOptions& options, Monitor& monitor);

/// "had flipped, zero-area or crushed faces, mended in place"
std::string in_words(const ChartRepair& repair);

}  // namespace atlas_refine
