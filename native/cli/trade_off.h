// The choice between seams, distortion and packing efficiency as a table and a picture.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "atlas_refine/result.h"

namespace atlas_refine::cli {

/// What an atlas comes to without cuts.
struct PackingPoint {
  double pe = 0;
  double distortion = 0;  ///< E_d
};

/// Lines `seams,PE,boundary growth,E_d,cuts` of the outcomes at the bound, then `packing,PE,0,E_d,0` of those without cuts.
std::string trade_off_csv(double pe_bound, const std::vector<TradeOff>& seams, const std::vector<PackingPoint>& packing);

/// Both as curves, side by side; `chosen` is the outcome that is written, -1 where it is none of them.
std::string trade_off_svg(double pe_bound, const std::vector<TradeOff>& seams, const std::vector<PackingPoint>& packing,
                          int chosen);

}  // namespace atlas_refine::cli
