// Progress and cancellation: one callback, called from the calling thread only.
#pragma once

#include <functional>
#include <string>

namespace atlas_refine {

struct Progress {
  std::string stage;  ///< "input", "embed", "align", "layout", "reduce", "pack", "squeeze", "certify", "compare"
  double fraction;    ///< of the whole call, in [0, 1], never decreasing
  double pe;          ///< packing efficiency of the present state, 0 where unknown
};

/// Return false to cancel; the call then throws RefineError(Cancelled). An empty function means "never cancel".
/// Called at least every 0.25 s on meshes up to 100k triangles.
using ProgressFn = std::function<bool(const Progress&)>;

}  // namespace atlas_refine
