// What a road came to, before it is certified.
#pragma once

#include <optional>

#include "atlas_refine/result.h"
#include "cut/cut_atlas.h"
#include "reduce/reduce.h"
#include "report/journal.h"
#include "report/measure_atlas.h"

namespace atlas_refine {

/// What all steps of one call share.
struct Refinement {
  const InputAtlas& input;
  const RefineOptions& options;
  Monitor& monitor;
  Journal& journal;
  int threads;
  /// Where the box is the texture: as it was asked, while `options` are for the box within its border.
  const RefineOptions& asked;
};

struct Solution {
  Intervention intervention = Intervention::Moved;
  CutAtlas atlas;  ///< pieces where they are to lie
  Gap gap;         ///< that is kept
  Ended ended = Ended::NotRun;
  double price = 0;
  double rough_energy = 0;       ///< Squeezed::rough_energy
  WarmStart end = {};            ///< where it was squeezed, but for charts held: for what goes on from here
  int held = 0;                  ///< Squeezed::held
  int outgrown = 0;              ///< how many charts would outgrow the density that they keep for the bound
  std::vector<int> re_embedded;  ///< charts
  std::optional<RectangleReport> rectangles;
  std::optional<CutReport> cuts;
};

inline Ended ended_of(ReduceStatus status) {
  switch (status) {
    case ReduceStatus::Converged:
      return Ended::AtOptimum;
    case ReduceStatus::Enough:
      return Ended::Enough;
    case ReduceStatus::TooDistorted:
      return Ended::DistortionLimit;
    case ReduceStatus::OutOfTime:
      return Ended::OutOfIterations;
    case ReduceStatus::Stopped:
      return Ended::Stopped;
    case ReduceStatus::Stalled:
    case ReduceStatus::TooExpensive:
      return Ended::Stalled;
  }
  return Ended::Stalled;
}

}  // namespace atlas_refine
