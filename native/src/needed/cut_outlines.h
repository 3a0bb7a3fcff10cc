// What the pieces that cuts leave are likely to lose, told by their outlines alone: soon enough to look at every cut.
#pragma once

#include <optional>
#include <vector>

#include "atlas_refine/options.h"
#include "needed/cut_shapes.h"
#include "seams/chart_cuts.h"

namespace atlas_refine {

/// A loop of a chart's border.
struct OutlineLoop {
  std::vector<int> vertices;
  std::vector<Vec2> at;     ///< where cuts are made
  std::vector<Vec2> shape;  ///< as it came; empty where that is the same
};

class CutOutlines {
 public:
  /// `shapes` must outlive this.
  CutOutlines(const RefineOptions& options, const std::vector<ChartCuts>& charts, const ShapesAsTheyCame& shapes);

  /// E_d that the pieces are likely to lose because the box that they are packed in unbent is too large, and, where they were
  /// bent because they overlapped themselves and still do, by that.
  double strain() const { return strain(charts_); }
  /// The same with one more cut; nothing where that does not run from border to border.
  std::optional<double> strain_with(const CutPlace& cut) const;
  /// The same with these cuts of one chart instead of those that it has.
  double strain_with(int chart, const ChartCuts& cuts) const;

 private:
  std::vector<OutlineLoop> loops_of(int chart, const ChartCuts& cuts) const;
  double strain(const std::vector<std::vector<OutlineLoop>>& charts) const;

  const RefineOptions& options_;
  const ShapesAsTheyCame& shapes_;
  std::vector<std::vector<OutlineLoop>> charts_;
};

}  // namespace atlas_refine
