// The parts that cuts along edges take a chart apart into, and which of the cuts are worth keeping.
#pragma once

#include <array>
#include <vector>

#include "geometry/split_mesh.h"

namespace atlas_refine {

class EdgeParts {
 public:
  /// `mesh` is `chart`, undivided.
  EdgeParts(const SplitMesh& mesh, const Chart& chart);

  void cut(const std::vector<Side>& sides);
  /// True where the vertex lies on the chart's boundary or on a cut.
  bool on_border(int vertex) const { return on_border_[vertex]; }

  /// The sides, one of each edge, that lie between two parts once parts that are slivers have joined the neighbour with which
  /// they share the longest border.
  std::vector<Side> seams() const;

 private:
  const SplitMesh& mesh_;
  const Chart& chart_;
  std::vector<std::array<char, 3>> is_cut_;
  std::vector<char> on_border_;
};

}  // namespace atlas_refine
