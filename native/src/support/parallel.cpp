// Deterministic parallel loops on the threads of a pool.
#include "support/parallel.h"

#include <algorithm>
#include <atomic>
#include <thread>

#include "support/thread_pool.h"

namespace atlas_refine {
namespace {

constexpr int kPartsPerThread = 4;  // of unequal work a thread that is done early takes more

}  // namespace

int resolve_threads(int requested) {
  if (requested > 0) return requested;
  return std::max(1u, std::thread::hardware_concurrency());
}

void parallel_ranges(int count, int threads, int grain, const std::function<void(int, int)>& body) {
  const int most = std::max(1, count / std::max(1, grain));
  if (std::min(threads, most) <= 1) {
    if (count > 0) body(0, count);
    return;
  }
  const int parts = std::min(most, kPartsPerThread * threads);
  const ThreadPoolScope pool(threads);
  ThreadPool::present()->run(parts, threads - 1, [&](int part) {
    body(static_cast<int>(static_cast<long long>(count) * part / parts),
         static_cast<int>(static_cast<long long>(count) * (part + 1) / parts));
  });
}

void side_by_side(int threads, const std::vector<std::function<void()>>& tasks) {
  parallel_ranges(static_cast<int>(tasks.size()), threads, 1, [&](int begin, int end) {
    for (int k = begin; k < end; ++k) tasks[k]();
  });
}

void parallel_in_order(int count, int threads, const std::function<void(int, int)>& prepare,
                       const std::function<void(int, int)>& add) {
  if (threads <= 1) {
    for (int k = 0; k < count; ++k) {
      prepare(k, 0);
      add(k, 0);
    }
    return;
  }
  // Indices are begun in order and end in order, so those under way follow each other: each has a slot of its own.
  std::atomic<int> added = 0;
  const ThreadPoolScope pool(threads);
  ThreadPool::present()->run(count, threads - 1, [&](int k) {
    prepare(k, k % threads);
    for (int before = added; before != k; before = added) added.wait(before);
    add(k, k % threads);
    added = k + 1;
    added.notify_all();
  });
}

}  // namespace atlas_refine
