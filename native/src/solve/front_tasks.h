// The supernodes of one factorisation as tasks for several threads.
#pragma once

#include <functional>
#include <vector>

#include "solve/supernodes.h"

namespace atlas_refine {

/// Supernodes [begin, end) that one thread takes: a subtree, or one supernode above such.
struct FrontTask {
  int begin, end;
  int parent;  ///< task above it, -1 for roots
};

/// Tasks in postorder; one thread gets a single one.
std::vector<FrontTask> divide_fronts(const Supernodes& tree, int threads);

/// Called with a task and a worker, 0 to threads - 1; where it returns false the rest is left.
using TaskBody = std::function<bool(int, int)>;

/// Every task after its children. False where one was.
bool run_tasks_up(const std::vector<FrontTask>& tasks, int threads, const TaskBody& body);
/// Every task after its parent.
bool run_tasks_down(const std::vector<FrontTask>& tasks, int threads, const TaskBody& body);

}  // namespace atlas_refine
