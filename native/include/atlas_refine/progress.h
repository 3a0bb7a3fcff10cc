// Progress, an early end and cancellation: one callback, called from the calling thread only.
#pragma once

#include <functional>
#include <string>

namespace atlas_refine {

struct Progress {
  std::string stage;  ///< "input", "embed", "align", "layout", "reduce", "pack", "squeeze", "certify", "compare"
  double fraction;    ///< of the whole call, in [0, 1], never decreasing
  double pe;          ///< packing efficiency of the present state, 0 where unknown
};

/// What the callback answers; true is GoOn and false is Cancel.
class Answer {
 public:
  enum Kind {
    GoOn,
    Finish,  ///< end early: RefineResult has the best valid atlas so far, where that is better than the input, and Ended::Stopped
    Cancel,  ///< the call throws RefineError(Cancelled)
  };
  Answer(Kind kind) : kind_(kind) {}
  Answer(bool go_on) : kind_(go_on ? GoOn : Cancel) {}
  Kind kind() const { return kind_; }

 private:
  Kind kind_;
};

/// An empty function means "always go on". Finish needs to be answered once only. Called at least every 0.25 s on meshes up to
/// 100k triangles.
using ProgressFn = std::function<Answer(const Progress&)>;

}  // namespace atlas_refine
