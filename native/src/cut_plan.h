// Cuts planned: charts made usable, aligned to the axes, their layout searched (sections 3.1 and 3.2).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "align/align.h"
#include "cut/side_prices.h"
#include "geometry/freedom.h"
#include "layout/search_layout.h"
#include "report/solution.h"

namespace atlas_refine {

/// A solution, or why there is none.
struct Attempt {
  std::optional<Solution> solution = {};
  bool needless = false;        ///< no chart needs a cut
  std::string failure = {};     ///< why cuts did not lead to the bound
  std::vector<int> uncut = {};  ///< charts that bend and have no trails: deformed to rectangles, or not to the axes at all
};

/// What is known before the cuts.
struct CutPlan {
  CutAtlas atlas;              ///< the charts free of flips, at their wanted densities; a piece each, seams where one was opened
  std::vector<Chart> charts;   ///< those pieces
  std::vector<Chart> sources;  ///< what divided meshes are parts of: the charts, or the input's where one was opened
  Freedoms freedom;
  std::vector<SidePrices> prices;
  std::vector<AxisAlignedChart> aligned;
  Layout layout;
  std::vector<Layout> others;  ///< by other cuts, worse by eq. (11)
  std::vector<int> mended;     ///< charts
  double enough = 0;           ///< the objective where the paper stops, 0 = at the optimum
};

/// Throws UnmendedCharts.
CutPlan plan_cuts(const Refinement& run, const ProgressRange& range);

/// What the layout search is asked for.
LayoutOptions layout_options(const Refinement& run);

RectangleReport report_of(const CutPlan& plan);

/// Attempt::uncut
std::vector<int> uncut_charts(const CutPlan& plan);

}  // namespace atlas_refine
