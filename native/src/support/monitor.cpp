// The monitor and the thread that polls it.
#include "support/monitor.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <system_error>
#include <thread>

#include "atlas_refine/error.h"

namespace atlas_refine {

void Monitor::begin_stage(std::string stage, double from, double to) {
  const std::lock_guard lock(mutex_);
  throw_if_asked();
  present_.stage = std::move(stage);
  present_.fraction = std::max(present_.fraction, from);
  from_ = from;
  to_ = to;
}

void Monitor::report(double fraction, double pe) {
  const std::lock_guard lock(mutex_);
  throw_if_asked();
  present_.fraction = std::max(present_.fraction, from_ + (to_ - from_) * std::clamp(fraction, 0.0, 1.0));
  present_.pe = pe;
}

void Monitor::check() const {
  const std::lock_guard lock(mutex_);
  throw_if_asked();
}

void Monitor::cancel() {
  const std::lock_guard lock(mutex_);
  cancelled_ = true;
}

void Monitor::finish() {
  const std::lock_guard lock(mutex_);
  finishing_ = true;
}

bool Monitor::finishing() const {
  const std::lock_guard lock(mutex_);
  return finishing_;
}

void Monitor::set_worthless(bool worthless) {
  const std::lock_guard lock(mutex_);
  worthless_ = worthless;
}

Progress Monitor::snapshot() const {
  const std::lock_guard lock(mutex_);
  return present_;
}

void Monitor::throw_if_asked() const {
  if (cancelled_) throw RefineError(ErrorCode::Cancelled, present_.stage, "cancelled");
  if (finishing_ && worthless_) throw GivenUp{};
}

namespace {

/// The work on a thread of its own, and how it ended.
struct Worker {
  std::mutex mutex;
  std::condition_variable ended;
  bool done = false;
  std::exception_ptr error;
  std::jthread thread;

  void start(const std::function<void(Monitor&)>& work, Monitor& monitor) {
    thread = std::jthread([&] {
      try {
        work(monitor);
      } catch (...) {
        error = std::current_exception();
      }
      const std::lock_guard lock(mutex);
      done = true;
      ended.notify_one();
    });
  }
  bool wait(std::chrono::milliseconds most) {
    std::unique_lock lock(mutex);
    return ended.wait_for(lock, most, [&] { return done; });
  }
};

}  // namespace

void run_monitored(const ProgressFn& progress, const std::function<void(Monitor&)>& work) {
  Monitor monitor;
  if (!progress) return work(monitor);
  Worker worker;
  try {
    worker.start(work, monitor);
  } catch (const std::system_error&) {
    // The system gives no thread: better without progress than not at all.
    return work(monitor);
  }
  std::exception_ptr callback_error;
  while (!worker.wait(std::chrono::milliseconds(50))) {
    if (callback_error) continue;
    try {
      const Answer answer = progress(monitor.snapshot());
      if (answer.kind() == Answer::Cancel) monitor.cancel();
      if (answer.kind() == Answer::Finish) monitor.finish();
    } catch (...) {
      callback_error = std::current_exception();
      monitor.cancel();
    }
  }
  worker.thread.join();
  if (callback_error) std::rethrow_exception(callback_error);
  if (worker.error) std::rethrow_exception(worker.error);
}

}  // namespace atlas_refine
