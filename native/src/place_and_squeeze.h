// Where the roads meet: the pieces of an atlas placed anew, and bent as far as the bound needs.
#pragma once

#include <optional>

#include "geometry/freedom.h"
#include "reduce/squeeze.h"
#include "report/solution.h"

namespace atlas_refine {

/// `atlas`: pieces at their wanted densities, each free of flips and crossings by itself. `keeps_place`: they may also start
/// where they lie. The result is only moved where that holds the bound, unless `run.options.relax`. Throws RefineError(BadInput)
/// where they cannot be placed apart.
Solution place_and_squeeze(const Refinement& run, const CutAtlas& atlas, bool keeps_place, const ProgressRange& range);

/// The same for charts that were cut: to the least distortion under the bound, unless the road stops at the input's. Nothing
/// where they do not reach the bound.
std::optional<Solution> place_and_squeeze_cut(const Refinement& run, const CutAtlas& cut, const ProgressRange& range);

/// E_d that these pieces would have at the bound, roughly; nothing where that is above `most`.
std::optional<double> squeezed_distortion(const Refinement& run, const CutAtlas& atlas, bool keeps_place, double most);

/// Pieces that lie where they were in `from`, which was squeezed, and a little apart where they were cut: squeezed on from there.
/// Nothing where the bound is not reached.
std::optional<Solution> squeeze_in_place(const Refinement& run, const CutAtlas& laid, const Solution& from);

/// The objective of these at the bound, sooner and rougher. Nothing where the bound is not reached. Several may run at once.
std::optional<Forecast> forecast_in_place(const Refinement& run, const CutAtlas& laid, const Solution& from);

/// The same for pieces that are placed anew. Several may run at once.
std::optional<Forecast> forecast_anew(const Refinement& run, const CutAtlas& atlas);
/// `atlas` to the end of that; nothing where that does not hold the bound.
std::optional<Solution> squeeze_as_forecast(const Refinement& run, const CutAtlas& atlas, const Forecast& forecast);

}  // namespace atlas_refine
