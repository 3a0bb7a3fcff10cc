// Subtrees of about equal work, and the threads that take what is ready.
#include "solve/front_tasks.h"

#include <condition_variable>
#include <mutex>

#include "support/parallel.h"

namespace atlas_refine {
namespace {

constexpr int kTasksPerThread = 6;
constexpr double kLeastWork = 3e6;  // in blocks, a millisecond's: below it a thread costs more than it gains

/// What the threads share; all of it under the mutex.
struct Queue {
  std::mutex mutex;
  std::condition_variable changed;
  std::vector<int> ready;
  std::vector<int> waits_for;
  int left = 0;
  bool failed = false;
};

void finish(int task, bool good, const std::vector<FrontTask>& tasks, Queue& queue) {
  --queue.left;
  if (!good) queue.failed = true;
  const int parent = tasks[task].parent;
  if (parent >= 0 && --queue.waits_for[parent] == 0) queue.ready.push_back(parent);
  queue.changed.notify_all();
}

void work_on(const std::vector<FrontTask>& tasks, Queue& queue, int worker, const std::function<bool(int, int)>& body) {
  std::unique_lock lock(queue.mutex);
  while (true) {
    queue.changed.wait(lock, [&] { return queue.failed || queue.left == 0 || !queue.ready.empty(); });
    if (queue.failed || queue.left == 0) return;
    const int task = queue.ready.back();
    queue.ready.pop_back();
    lock.unlock();
    bool good = false;
    try {
      good = body(task, worker);
    } catch (...) {
      lock.lock();
      finish(task, false, tasks, queue);
      throw;
    }
    lock.lock();
    finish(task, good, tasks, queue);
  }
}

}  // namespace

std::vector<FrontTask> divide_fronts(const Supernodes& tree, int threads) {
  const int count = tree.count();
  std::vector<double> work(count);  // of each subtree
  std::vector<int> begin(count);
  double total = 0;
  for (int s = 0; s < count; ++s) {
    work[s] += tree.work(s);
    begin[s] = tree.child_start[s] < tree.child_start[s + 1] ? begin[tree.children[tree.child_start[s]]] : s;
    if (tree.parent[s] >= 0)
      work[tree.parent[s]] += work[s];
    else
      total += work[s];
  }
  if (threads <= 1 || total < kLeastWork) return {{0, count, -1, 0}};
  const double most = total / (threads * kTasksPerThread);
  std::vector<FrontTask> tasks;
  std::vector<int> task_of(count, -1);  // of the last supernode in each
  for (int s = 0; s < count; ++s) {
    const int p = tree.parent[s];
    if (work[s] <= most && p >= 0 && work[p] <= most) continue;  // inside a subtree
    task_of[s] = static_cast<int>(tasks.size());
    tasks.push_back({work[s] <= most ? begin[s] : s, s + 1, -1, 0});
  }
  for (int s = 0; s < count; ++s) {
    if (task_of[s] < 0 || tree.parent[s] < 0) continue;
    tasks[task_of[s]].parent = task_of[tree.parent[s]];
    ++tasks[task_of[tree.parent[s]]].children;
  }
  return tasks;
}

bool run_tasks(const std::vector<FrontTask>& tasks, int threads, const std::function<bool(int, int)>& body) {
  if (tasks.size() == 1) return body(0, 0);
  Queue queue;
  queue.left = static_cast<int>(tasks.size());
  for (int k = queue.left - 1; k >= 0; --k) {
    queue.waits_for.insert(queue.waits_for.begin(), tasks[k].children);
    if (tasks[k].children == 0) queue.ready.push_back(k);
  }
  parallel_ranges(threads, threads, 1, [&](int begin, int end) {
    for (int worker = begin; worker < end; ++worker) work_on(tasks, queue, worker, body);
  });
  return !queue.failed;
}

}  // namespace atlas_refine
