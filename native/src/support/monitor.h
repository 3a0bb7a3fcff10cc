// Progress, an early end and cancellation for code that runs on worker threads: stages report here, the caller's callback is
// polled.
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
  /// Asks for the best result so far: searches end with what they have.
  void finish();
  bool finishing() const;
  Progress snapshot() const;

  /// Thrown by reports once finish() was called, as long as a Worthless lives.
  struct GivenUp {};
  /// What is half done while this lives is of no use to anybody.
  class Worthless {
   public:
    explicit Worthless(Monitor& monitor) : monitor_(monitor) { monitor_.set_worthless(true); }
    ~Worthless() { monitor_.set_worthless(false); }
    Worthless(const Worthless&) = delete;
    Worthless& operator=(const Worthless&) = delete;

   private:
    Monitor& monitor_;
  };

 private:
  void set_worthless(bool worthless);
  void throw_if_asked() const;

  mutable std::mutex mutex_;
  Progress present_{"input", 0, 0};
  double from_ = 0, to_ = 1;
  bool cancelled_ = false, finishing_ = false, worthless_ = false;
};

/// Runs `work` on a thread of its own and polls `progress` from the calling thread every 50 ms.
/// Without a callback the work runs in the calling thread. Exceptions of either side are rethrown after the work has ended.
void run_monitored(const ProgressFn& progress, const std::function<void(Monitor&)>& work);

}  // namespace atlas_refine
