// What the paper's road needs of a chart before it is deformed: a disk whose triangulation can become axis-aligned.
#pragma once

#include "cut/open_to_disk.h"

namespace atlas_refine {

/// A chart made ready.
struct PreparedChart {
  SplitMesh mesh;
  Opening opening;
};

/// Opens the chart to a disk at these prices, divides boundary edges that are long beside the
/// others (Fig. 23) and every inner edge between two boundary vertices: the third side of an ear is one of those.
PreparedChart prepare_chart(const Chart& chart, const SidePrices& prices = {});

}  // namespace atlas_refine
