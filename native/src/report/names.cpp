// The stable names of results.
#include "atlas_refine/result.h"

namespace atlas_refine {

const char* to_string(Intervention intervention) {
  switch (intervention) {
    case Intervention::Unchanged:
      return "unchanged";
    case Intervention::Moved:
      return "moved";
    case Intervention::Squeezed:
      return "squeezed";
    case Intervention::Cut:
      return "cut";
  }
  return "unknown";
}

const char* to_string(Fate fate) {
  switch (fate) {
    case Fate::Refined:
      return "refined";
    case Fate::Left:
      return "left";
    case Fate::Stacked:
      return "stacked";
    case Fate::Kept:
      return "kept";
    case Fate::Locked:
      return "locked";
  }
  return "unknown";
}

const char* to_string(Ended ended) {
  switch (ended) {
    case Ended::NotRun:
      return "not_run";
    case Ended::AtOptimum:
      return "at_optimum";
    case Ended::Enough:
      return "enough";
    case Ended::Stalled:
      return "stalled";
    case Ended::OutOfIterations:
      return "out_of_iterations";
    case Ended::DistortionLimit:
      return "distortion_limit";
    case Ended::Stopped:
      return "stopped";
  }
  return "unknown";
}

}  // namespace atlas_refine
