// Progress and cancellation within the packer: the tick is called from the
// calling thread only, the others follow it.
#pragma once

#include <algorithm>
#include <atomic>
#include <exception>
#include <functional>
#include <thread>

namespace atlas_refine {

/// Polled by all workers of one packing. The tick may throw to cancel; the
/// other workers then end as well.
class Watch {
 public:
  explicit Watch(std::function<void(double)> tick) : tick_(std::move(tick)), caller_(std::this_thread::get_id()) {}

  /// The part [from, to] of the whole that follows.
  void begin_part(double from, double to) { part_from_ = from_ = from, part_to_ = to_ = to; }

  /// The task-th of `tasks` equal tasks of the present part; counts for the calling thread's tasks only.
  void begin_task(int task, int tasks) {
    if (std::this_thread::get_id() != caller_) return;
    from_ = part_from_ + (part_to_ - part_from_) * task / tasks;
    to_ = part_from_ + (part_to_ - part_from_) * (task + 1) / tasks;
  }

  /// `fraction` of the present task. Cheap; call it at least every 0.05 s.
  void poll(double fraction) {
    if (std::this_thread::get_id() != caller_) {
      if (cancelled_) std::rethrow_exception(thrown_);
      return;
    }
    if (!tick_) return;
    try {
      tick_(from_ + (to_ - from_) * std::min(fraction, 1.0));
    } catch (...) {
      thrown_ = std::current_exception();
      cancelled_ = true;
      throw;
    }
  }

 private:
  std::function<void(double)> tick_;
  std::thread::id caller_;
  std::atomic<bool> cancelled_ = false;
  std::exception_ptr thrown_;           ///< by the tick, then by everyone; set before the flag
  double part_from_ = 0, part_to_ = 1;  ///< the calling thread's, like the next
  double from_ = 0, to_ = 1;
};

}  // namespace atlas_refine
