// A chart that overlaps itself embedded anew: Tutte, then least distortion under the barrier.
#pragma once

#include <optional>

#include "geometry/chart.h"
#include "support/monitor.h"

namespace atlas_refine {

/// The chart without overlap, at its own optimum of E_d (eq. 9) with all borders at least the default gap apart; its UVs are
/// not read. It must be a disk or a disk with holes. Nothing where no embedding of acceptable distortion was found.
std::optional<Chart> embed(const Chart& chart, int threads, Monitor& monitor);

}  // namespace atlas_refine
