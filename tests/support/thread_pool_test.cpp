// The pool: every part once, whoever calls from where, exceptions as on one thread, threads that are kept and that end.
#include "support/thread_pool.h"

#include <gtest/gtest.h>

#include <atomic>
#include <mutex>
#include <numeric>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "support/parallel.h"

namespace atlas_refine {
namespace {

TEST(ThreadPool, RunsEveryPartOnceCallAfterCall) {
  ThreadPool pool(3);
  for (int call = 0; call < 2000; ++call) {
    std::vector<int> visits(call % 9, 0);
    pool.run(call % 9, 3, [&](int part) { ++visits[part]; });
    ASSERT_EQ(visits, std::vector<int>(call % 9, 1)) << call;
  }
}

TEST(ThreadPool, KeepsItsThreads) {
  ThreadPool pool(2);
  std::mutex mutex;
  std::set<std::thread::id> seen;
  for (int call = 0; call < 500; ++call) {
    pool.run(6, 2, [&](int) {
      const std::lock_guard lock(mutex);
      seen.insert(std::this_thread::get_id());
    });
  }
  EXPECT_LE(seen.size(), 3u);
}

TEST(ThreadPool, CallsFromWithinPartsEnd) {
  ThreadPool pool(2);
  std::vector<int> sums(5, 0);
  pool.run(5, 2, [&](int outer) {
    std::vector<int> own(40, 0);
    pool.run(40, 2, [&](int part) { own[part] = part; });
    sums[outer] = std::accumulate(own.begin(), own.end(), 0);
  });
  EXPECT_EQ(sums, std::vector<int>(5, 780));
}

TEST(ThreadPool, RethrowsTheExceptionOfTheLowestPartAndGoesOn) {
  ThreadPool pool(3);
  for (int call = 0; call < 200; ++call) {
    try {
      pool.run(50, 3, [](int part) {
        if (part % 7 == 5) throw std::runtime_error(std::to_string(part));
      });
      ADD_FAILURE() << "no exception";
    } catch (const std::runtime_error& error) {
      ASSERT_STREQ(error.what(), "5");
    }
  }
  std::atomic<int> parts = 0;
  pool.run(50, 3, [&](int) { ++parts; });
  EXPECT_EQ(parts, 50);
}

TEST(ThreadPoolScope, IsSharedByLoopsAndLeavesNoThread) {
  EXPECT_EQ(ThreadPool::present(), nullptr);
  {
    const ThreadPoolScope outer(3);
    ThreadPool* const shared = ThreadPool::present();
    ASSERT_NE(shared, nullptr);
    {
      const ThreadPoolScope inner(2);
      EXPECT_EQ(ThreadPool::present(), shared);
    }
    std::vector<ThreadPool*> pools(64, nullptr);
    parallel_ranges(64, 3, 1, [&](int begin, int end) {
      for (int k = begin; k < end; ++k) pools[k] = ThreadPool::present();
    });
    EXPECT_EQ(pools, std::vector<ThreadPool*>(64, shared));
  }
  EXPECT_EQ(ThreadPool::present(), nullptr);
}

}  // namespace
}  // namespace atlas_refine
