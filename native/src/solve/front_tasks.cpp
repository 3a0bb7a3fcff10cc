// Subtrees of about equal work, and the threads that take what is ready.
#include "solve/front_tasks.h"

#include <condition_variable>
#include <mutex>

#include "support/parallel.h"

namespace atlas_refine {
namespace {

constexpr int kTasksPerThread = 6;
constexpr double kLeastWork = 3e6;  // in blocks, a millisecond's: below it a thread costs more than it gains

/// What the threads share; all that changes is under the mutex.
struct Queue {
  std::mutex mutex;
  std::condition_variable changed;
  std::vector<std::vector<int>> releases;  ///< of each task: those that wait for it
  std::vector<int> waits_for;
  std::vector<int> ready;
  int left = 0;
  bool failed = false;
};

void finish(int task, bool good, Queue& queue) {
  --queue.left;
  if (!good) queue.failed = true;
  for (const int next : queue.releases[task]) {
    if (--queue.waits_for[next] == 0) queue.ready.push_back(next);
  }
  queue.changed.notify_all();
}

/// Upwards a task releases at most the one above it, which its own thread goes on with: who finds none ready is free to help with
/// large fronts.
void work_on(Queue& queue, bool up, int worker, const TaskBody& body) {
  std::unique_lock lock(queue.mutex);
  while (true) {
    if (!up) queue.changed.wait(lock, [&] { return queue.failed || queue.left == 0 || !queue.ready.empty(); });
    if (queue.failed || queue.ready.empty()) return;
    const int task = queue.ready.back();
    queue.ready.pop_back();
    lock.unlock();
    bool good = false;
    try {
      good = body(task, worker);
    } catch (...) {
      lock.lock();
      finish(task, false, queue);
      throw;
    }
    lock.lock();
    finish(task, good, queue);
  }
}

bool run_tasks(const std::vector<FrontTask>& tasks, bool up, int threads, const TaskBody& body) {
  if (tasks.size() == 1) return body(0, 0);
  const int count = static_cast<int>(tasks.size());
  Queue queue;
  queue.left = count;
  queue.releases.resize(count);
  queue.waits_for.assign(count, 0);
  for (int task = 0; task < count; ++task) {
    if (tasks[task].parent < 0) continue;
    const int before = up ? task : tasks[task].parent, after = up ? tasks[task].parent : task;
    queue.releases[before].push_back(after);
    ++queue.waits_for[after];
  }
  for (int task = 0; task < count; ++task) {
    if (queue.waits_for[task] == 0) queue.ready.push_back(task);
  }
  parallel_ranges(threads, threads, 1, [&](int begin, int end) {
    for (int worker = begin; worker < end; ++worker) work_on(queue, up, worker, body);
  });
  return !queue.failed;
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
  if (threads <= 1 || total < kLeastWork) return {{0, count, -1}};
  const double most = total / (threads * kTasksPerThread);
  std::vector<FrontTask> tasks;
  std::vector<int> task_of(count, -1);  // of the last supernode in each
  for (int s = 0; s < count; ++s) {
    const int p = tree.parent[s];
    if (work[s] <= most && p >= 0 && work[p] <= most) continue;  // inside a subtree
    task_of[s] = static_cast<int>(tasks.size());
    tasks.push_back({work[s] <= most ? begin[s] : s, s + 1, -1});
  }
  for (int s = 0; s < count; ++s) {
    if (task_of[s] >= 0 && tree.parent[s] >= 0) tasks[task_of[s]].parent = task_of[tree.parent[s]];
  }
  return tasks;
}

bool run_tasks_up(const std::vector<FrontTask>& tasks, int threads, const TaskBody& body) {
  return run_tasks(tasks, true, threads, body);
}

bool run_tasks_down(const std::vector<FrontTask>& tasks, int threads, const TaskBody& body) {
  return run_tasks(tasks, false, threads, body);
}

}  // namespace atlas_refine
