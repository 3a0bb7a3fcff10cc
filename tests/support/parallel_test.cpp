// Parallel loops cover every index once and hand the first exception on.
#include "support/parallel.h"

#include <gtest/gtest.h>

#include <numeric>
#include <stdexcept>
#include <vector>

namespace atlas_refine {
namespace {

TEST(ParallelRanges, CoverEveryIndexOnce) {
  for (const int threads : {1, 2, 7}) {
    for (const int count : {0, 1, 5, 1000}) {
      std::vector<int> visits(count, 0);
      parallel_ranges(count, threads, 1, [&](int begin, int end) {
        for (int i = begin; i < end; ++i) ++visits[i];
      });
      EXPECT_EQ(visits, std::vector<int>(count, 1)) << threads << " threads, " << count;
    }
  }
}

TEST(ParallelRanges, RethrowAfterAllHaveEnded) {
  const auto fail = [](int begin, int) {
    if (begin >= 0) throw std::out_of_range("range");
  };
  EXPECT_THROW(parallel_ranges(100, 4, 1, fail), std::out_of_range);
  EXPECT_THROW(parallel_ranges(100, 1, 1, fail), std::out_of_range);
}

TEST(SideBySide, AllAreDoneAndTheFirstFailureIsTold) {
  for (const int threads : {1, 2, 7}) {
    int first = 0, second = 0;
    side_by_side(threads, {[&] { first = 1; }, [&] { second = 2; }});
    EXPECT_EQ(first, 1);
    EXPECT_EQ(second, 2);
    EXPECT_THROW(side_by_side(threads, {[] { throw std::out_of_range("first"); }, [] { throw std::runtime_error("second"); }}),
                 std::out_of_range);
  }
}

TEST(ParallelInOrder, AddsInOrderWhatWasPreparedInSlotsOfItsOwn) {
  for (const int threads : {1, 2, 7}) {
    for (const int count : {0, 1, 5, 1000}) {
      std::vector<int> slots(threads, -1), added;
      parallel_in_order(
          count, threads, [&](int k, int slot) { slots[slot] = k; },
          [&](int k, int slot) {
            EXPECT_EQ(slots[slot], k);
            added.push_back(k);
          });
      std::vector<int> expected(count);
      std::iota(expected.begin(), expected.end(), 0);
      EXPECT_EQ(added, expected) << threads << " threads, " << count;
    }
  }
}

TEST(ResolveThreads, ZeroIsWhatTheMachineHas) {
  EXPECT_GE(resolve_threads(0), 1);
  EXPECT_EQ(resolve_threads(3), 3);
}

}  // namespace
}  // namespace atlas_refine
