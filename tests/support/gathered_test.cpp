// Joined results are those of one loop, in its order.
#include "support/gathered.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace atlas_refine {
namespace {

TEST(Gathered, IsInOrderWhateverTheThreads) {
  for (const int threads : {1, 2, 7}) {
    const ThreadPoolScope pool(threads);
    EXPECT_EQ(present_threads(), threads);
    for (const int count : {0, 1, 5, 1000}) {
      const auto even = [](int begin, int end, std::vector<int>& out) {
        for (int i = begin; i < end; ++i) {
          if (i % 2 == 0) out.push_back(i);
        }
      };
      std::vector<int> expected;
      even(0, count, expected);
      EXPECT_EQ(gathered<int>(count, 3, even), expected) << threads << " threads, " << count;
    }
  }
  EXPECT_EQ(present_threads(), 1) << "without a pool";
}

TEST(LeastOf, IsThatOfAllRangesAndTheBound) {
  for (const int threads : {1, 2, 7}) {
    const ThreadPoolScope pool(threads);
    const auto least = [](int begin, int end) {
      double out = 1000;
      for (int i = begin; i < end; ++i) out = std::min(out, std::abs(i - 617.5));
      return out;
    };
    EXPECT_EQ(least_of(1000, 10, 900, least), 0.5);
    EXPECT_EQ(least_of(1000, 10, 0.25, least), 0.25);
    EXPECT_EQ(least_of(0, 10, 900, least), 900);
  }
}

}  // namespace
}  // namespace atlas_refine
