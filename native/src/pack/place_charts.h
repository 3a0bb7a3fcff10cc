// Charts placed anew by the packer, the gap given as the fraction of a box that is only known afterwards.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "atlas_refine/options.h"
#include "geometry/freedom.h"
#include "pack/pack_charts.h"
#include "support/monitor.h"

namespace atlas_refine {

struct PlaceOptions {
  Gap gap;
  double box_aspect = 0;
  double target_pe = 1;                                      ///< good enough: stop searching there
  double most_pe = std::numeric_limits<double>::infinity();  ///< where charts cover more, the gap is that of a box of this PE
  std::uint64_t seed = 1;
  int threads = 1;
  PackSearch search = PackSearch::Thorough;
  Rotate rotate = Rotate::Any;
  bool align_axes = false;  ///< charts whose longest border runs straight get it onto an axis, unless rotate is None
};

/// A chart so long that it has no size that gap and box could go by.
struct Needle {
  int chart;
  std::string words;  ///< continue "chart 3 "
};
/// Charts longer than 400 sides of a square that holds all of them.
std::vector<Needle> needles_among(const std::vector<Chart>& charts);

/// The same charts, rigidly moved, at least the gap apart. Their scales and shapes are kept.
std::vector<Chart> place_charts(const std::vector<Chart>& charts, const PlaceOptions& options, Monitor& monitor);

/// The same in rows, see pack_in_rows(); nothing where they do not reach options.target_pe.
std::optional<std::vector<Chart>> place_in_rows(const std::vector<Chart>& charts, const PlaceOptions& options, Monitor& monitor);

/// Charts around fixed ones, which come with the texture's UVs in units of its height: in the smallest frame of
/// options.box_aspect that was found to hold them, or in one in which they cover options.target_pe less the fixed charts' share.
/// The charts lie in that frame, the fixed ones times its height; nothing where the fixed charts leave no room.
std::optional<PlacedCharts> place_around(const std::vector<Chart>& charts, const Freedoms& freedom, const PlaceOptions& options,
                                         Monitor& monitor);

/// UVs under the rigid motion that took a chart's UVs `from` where they lay `to` where they lie.
std::vector<Vec2> moved_likewise(std::vector<Vec2> uvs, const std::vector<Vec2>& from, const std::vector<Vec2>& to);

}  // namespace atlas_refine
