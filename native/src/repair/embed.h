// A chart that overlaps itself embedded anew: Tutte, then least distortion under the barrier, from the surface or from the input.
#pragma once

#include <optional>

#include "coarsen/sample_vertices.h"
#include "geometry/chart.h"
#include "support/monitor.h"

namespace atlas_refine {

/// What triangles are to look like: as on the surface, or as in the chart's UVs, where those that are not positive are to look as
/// on the surface too.
enum class Shapes { OfSurface, OfUvs };

/// A valid embedding, and where there are many triangles the vertices that coarse charts keep: no embedding changes them.
struct Spread {
  Chart chart;
  std::optional<Sample> sample = {};
};

/// An embedding to start from; nothing where none was found.
std::optional<Spread> spread_out(const Chart& chart, int threads, Monitor& monitor);

/// The chart without overlap, from its spread_out(), at its own optimum of the distortion from these shapes (eq. 9) with all
/// borders at least the default gap apart; polygons that have guards stay convex where that was found. It must be a disk or a
/// disk with holes. Nothing where no embedding of acceptable distortion was found.
std::optional<Chart> embed(const Chart& chart, const Spread& start, Shapes shapes, int threads, Monitor& monitor);

}  // namespace atlas_refine
