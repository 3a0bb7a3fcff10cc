// One refine() in a thread of its own, which never touches Python: start, poll, cancel, result.
#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>

#include "atlas_refine/refine.h"

namespace atlas_refine::python {

class Job {
 public:
  Job(Atlas atlas, const RefineOptions& options);
  ~Job();  ///< cancels and waits
  Job(const Job&) = delete;
  Job& operator=(const Job&) = delete;

  bool done() const;
  Progress progress() const;
  void cancel() { cancelled_ = true; }
  void finish() { finishing_ = true; }
  /// Waits at most `seconds` (for ever where negative); true where the job is done.
  bool wait(double seconds) const;
  /// Waits for the end; throws what the call threw.
  const RefineResult& result() const;

  /// Cancels and joins every job that is alive: what a process must do before it exits.
  static void stop_all();

 private:
  void run();
  void stop();

  const Atlas atlas_;
  const RefineOptions options_;
  std::atomic<bool> cancelled_ = false, finishing_ = false;
  mutable std::mutex mutex_;
  mutable std::condition_variable finished_;
  Progress progress_{"input", 0.0, 0.0};
  bool done_ = false;
  std::optional<RefineResult> result_;
  std::exception_ptr error_;
  std::thread thread_;  // last: starts when everything above is ready
};

void bind_job(pybind11::module_& module);

}  // namespace atlas_refine::python
