// Threads that wait for work: started once, used by every parallel loop of a call.
#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace atlas_refine {

/// The threads beside those that call. One that calls from within a part is helped like any other; nobody ever waits for a part
/// that has not begun, so calls may be nested as deep as they like.
class ThreadPool {
 public:
  /// Starts its threads with the first call that needs them.
  explicit ThreadPool(int helpers) : most_helpers_(helpers) {}
  /// Ends them. No call may be under way.
  ~ThreadPool();
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  /// Calls body(0) to body(parts - 1) on this thread and on as many as `helpers` others, begun in this order; returns when all
  /// have ended. Of exceptions that of the lowest part is rethrown, as on one thread, and what had not begun by then is left. The
  /// calling thread's account (support/profile.h) is that of all.
  void run(int parts, int helpers, const std::function<void(int)>& body);

  /// The pool of this thread: the one that it helps, or that a ThreadPoolScope has given it; nullptr where there is none.
  static ThreadPool* present();

  /// With the one that calls.
  int threads() const { return most_helpers_ + 1; }

 private:
  friend class ThreadPoolScope;
  struct Call;

  static void set_present(ThreadPool* pool);
  void start_helpers();
  void help();
  Call* open_call() const;
  static void take_parts(Call& call, std::unique_lock<std::mutex>& lock);

  int most_helpers_;
  std::mutex mutex_;  // of all below, and of calls
  std::condition_variable called_, ended_;
  std::vector<Call*> calls_;  // innermost last
  bool closing_ = false;
  std::vector<std::jthread> helpers_;
};

/// Threads that loops in this one may use where nobody tells them: those of its pool, 1 where it has none.
inline int present_threads() { return ThreadPool::present() ? ThreadPool::present()->threads() : 1; }

/// While it lives, parallel loops of this thread share one pool: that of an outer scope, or its own. None outlives the outermost
/// scope, so that no thread is left where a process forks or unloads the library.
class ThreadPoolScope {
 public:
  explicit ThreadPoolScope(int threads);
  ~ThreadPoolScope();
  ThreadPoolScope(const ThreadPoolScope&) = delete;
  ThreadPoolScope& operator=(const ThreadPoolScope&) = delete;

 private:
  ThreadPool* outer_;
  ThreadPool own_;
};

}  // namespace atlas_refine
