// The monitor and the thread that polls it.
#include "support/monitor.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <thread>

#include "atlas_refine/error.h"

namespace atlas_refine {

void Monitor::begin_stage(std::string stage, double from, double to) {
  const std::lock_guard lock(mutex_);
  throw_if_cancelled();
  present_.stage = std::move(stage);
  present_.fraction = std::max(present_.fraction, from);
  from_ = from;
  to_ = to;
}

void Monitor::report(double fraction, double pe) {
  const std::lock_guard lock(mutex_);
  throw_if_cancelled();
  present_.fraction = std::max(present_.fraction, from_ + (to_ - from_) * std::clamp(fraction, 0.0, 1.0));
  present_.pe = pe;
}

void Monitor::check() const {
  const std::lock_guard lock(mutex_);
  throw_if_cancelled();
}

void Monitor::cancel() {
  const std::lock_guard lock(mutex_);
  cancelled_ = true;
}

Progress Monitor::snapshot() const {
  const std::lock_guard lock(mutex_);
  return present_;
}

void Monitor::throw_if_cancelled() const {
  if (cancelled_) throw RefineError(ErrorCode::Cancelled, present_.stage, "cancelled");
}

void run_monitored(const ProgressFn& progress, const std::function<void(Monitor&)>& work) {
  Monitor monitor;
  if (!progress) {
    work(monitor);
    return;
  }
  std::mutex mutex;
  std::condition_variable ended;
  bool done = false;
  std::exception_ptr work_error, callback_error;
  {
    const std::jthread worker([&] {
      try {
        work(monitor);
      } catch (...) {
        work_error = std::current_exception();
      }
      const std::lock_guard lock(mutex);
      done = true;
      ended.notify_one();
    });
    std::unique_lock lock(mutex);
    while (!ended.wait_for(lock, std::chrono::milliseconds(50), [&] { return done; })) {
      if (callback_error) continue;
      lock.unlock();
      try {
        if (!progress(monitor.snapshot())) monitor.cancel();
      } catch (...) {
        callback_error = std::current_exception();
        monitor.cancel();
      }
      lock.lock();
    }
  }
  if (callback_error) std::rethrow_exception(callback_error);
  if (work_error) std::rethrow_exception(work_error);
}

}  // namespace atlas_refine
