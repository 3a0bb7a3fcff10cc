// The supernodes of one factorisation as tasks for several threads.
#pragma once

#include <functional>
#include <vector>

#include "solve/supernodes.h"

namespace atlas_refine {

/// Supernodes [begin, end) that one thread takes: a subtree, or one supernode above such.
struct FrontTask {
  int begin, end;
  int parent;    ///< the task that waits for it, -1 where none does
  int children;  ///< tasks that it waits for
};

/// Tasks in postorder; one thread gets a single one.
std::vector<FrontTask> divide_fronts(const Supernodes& tree, int threads);

/// Calls body(task, worker) for every task after its children, workers 0 to threads - 1 at the same time. False, and the rest is
/// left, where one returns false.
bool run_tasks(const std::vector<FrontTask>& tasks, int threads, const std::function<bool(int, int)>& body);

}  // namespace atlas_refine
