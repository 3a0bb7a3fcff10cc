// Parallel loops cover every index once and hand the first exception on.
#include "support/parallel.h"

#include <gtest/gtest.h>

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

TEST(ResolveThreads, ZeroIsWhatTheMachineHas) {
  EXPECT_GE(resolve_threads(0), 1);
  EXPECT_EQ(resolve_threads(3), 3);
}

}  // namespace
}  // namespace atlas_refine
