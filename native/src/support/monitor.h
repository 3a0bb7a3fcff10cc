// Progress and cancellation for code that runs on worker threads: stages report here, the caller's callback is polled.
#pragma once

#include <functional>
#include <mutex>
#include <string>

#include "atlas_refine/progress.h"

namespace atlas_refine {

/// Shared by all workers of one call. Reports never block for long and throw RefineError(Cancelled) once the caller has
/// asked to stop, so every loop that may take 0.1 s reports now and then.
class Monitor {
 public:
  /// What follows belongs to `stage` and covers the part [from, to] of the whole call.
  void begin_stage(std::string stage, double from, double to);
  /// `fraction` of the present stage; it never takes progress back. `pe` 0 where unknown.
  void report(double fraction, double pe = 0);
  void check() const;
  void cancel();
  Progress snapshot() const;

 private:
  void throw_if_cancelled() const;

  mutable std::mutex mutex_;
  Progress present_{"input", 0, 0};
  double from_ = 0, to_ = 1;
  bool cancelled_ = false;
};

/// Runs `work` on a thread of its own and polls `progress` from the calling thread every 50 ms; false from it cancels.
/// Without a callback the work runs in the calling thread. Exceptions of either side are rethrown after the work has ended.
void run_monitored(const ProgressFn& progress, const std::function<void(Monitor&)>& work);

}  // namespace atlas_refine
