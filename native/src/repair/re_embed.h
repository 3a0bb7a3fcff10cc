// Charts that overlap or touch themselves get a bijective embedding: touching vertices are parted; else Tutte, then least
// distortion under the barrier.
#pragma once

#include "geometry/chart.h"
#include "support/monitor.h"

namespace atlas_refine {

/// The chart without overlap: as it was but for touching vertices, where those were all; else at its own
/// optimum of E_d (eq. 9) with all borders at least the default gap apart.
/// Throws RefineError(BadInput) naming the chart where none exists (a handle) or none could be computed.
Chart re_embed(const Chart& chart, int chart_index, int threads, Monitor& monitor);

}  // namespace atlas_refine
