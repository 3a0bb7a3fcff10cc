// Deterministic parallel loops: every index writes its own slot, so one thread gives the same bits as many.
#pragma once

#include <functional>
#include <vector>

namespace atlas_refine {

/// Number of threads to use for a request, 0 = what the machine has.
int resolve_threads(int requested);

/// Calls body(begin, end) on disjoint ranges that cover [0, count); returns when all are done. The ranges depend on the
/// number of threads, so the body must treat its indices independently. The exception of the lowest range is rethrown.
/// Runs in the calling thread where `threads` is 1 or `count` is below twice the `grain`, else on the pool of this thread
/// (support/thread_pool.h) or, where it has none, on threads for this call.
void parallel_ranges(int count, int threads, int grain, const std::function<void(int, int)>& body);

/// Calls all tasks, in any order; returns when all are done. The exception of the first that failed in this list is rethrown.
void side_by_side(int threads, const std::vector<std::function<void()>>& tasks);

/// Calls prepare(k, slot) for every index below `count` in any order, and after it add(k, slot) in ascending order. No two
/// indices under way share a slot below `threads`. Neither may throw.
void parallel_in_order(int count, int threads, const std::function<void(int, int)>& prepare,
                       const std::function<void(int, int)>& add);

}  // namespace atlas_refine
