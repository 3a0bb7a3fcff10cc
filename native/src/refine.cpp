// The whole method, top to bottom.
#include "atlas_refine/refine.h"

#include "input/split_charts.h"

namespace atlas_refine {

const char* version() { return ATLAS_REFINE_VERSION; }

const char* to_string(Intervention intervention) {
  switch (intervention) {
    case Intervention::Unchanged: return "unchanged";
    case Intervention::Moved: return "moved";
    case Intervention::Squeezed: return "squeezed";
  }
  return "unknown";
}

RefineResult refine(const Atlas& atlas, const RefineOptions& options, const ProgressFn&, DebugSink*) {
  RefineResult result;
  result.before = measure(atlas, options.box_aspect);
  result.after = result.before;
  result.corner_uvs = atlas.corner_uvs;
  result.bound_met = validate(atlas).valid() && result.before.pe_fixed_aspect >= options.pe_bound;
  if (!result.bound_met) throw RefineError(ErrorCode::BoundNotReached, "squeeze", "the bound was not reached");
  return result;
}

}  // namespace atlas_refine
