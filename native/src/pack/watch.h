// Progress and cancellation within the packer: the tick is called from the
// calling thread only, the others follow it.
#pragma once

#include <atomic>
#include <functional>
#include <thread>

namespace atlas_refine {

/// Polled by all workers of one packing. The tick may throw to cancel; the
/// other workers then end as well.
class Watch {
 public:
  explicit Watch(std::function<void(double)> tick) : tick_(std::move(tick)), caller_(std::this_thread::get_id()) {}

  /// The part [from, to] of the whole that the following work of the calling
  /// thread covers.
  void begin_part(double from, double to) { from_ = from, to_ = to; }

  /// `fraction` of the present part. Cheap; call it at least every 0.05 s.
  void poll(double fraction) {
    if (std::this_thread::get_id() != caller_) {
      if (cancelled_) throw Cancelled{};
      return;
    }
    if (!tick_) return;
    try {
      tick_(from_ + (to_ - from_) * fraction);
    } catch (...) {
      cancelled_ = true;
      throw;
    }
  }

 private:
  struct Cancelled {};  ///< ends a worker; the calling thread throws what the tick threw

  std::function<void(double)> tick_;
  std::thread::id caller_;
  std::atomic<bool> cancelled_ = false;
  double from_ = 0, to_ = 1;
};

}  // namespace atlas_refine
