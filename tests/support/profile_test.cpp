// Accounts of processor time: every moment belongs to one phase, and what other threads do is told to the one that waits.
#include "support/profile.h"

#include <gtest/gtest.h>

#include <ctime>
#include <set>
#include <string>

#include "support/parallel.h"

namespace atlas_refine {
namespace {

double spent(const Account& account, Phase phase) { return account.seconds[static_cast<int>(phase)]; }

/// Keeps the processor busy.
void work(double seconds) {
  const auto now = [] {
    timespec time = {};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  };
  for (const double start = now(); now() < start + seconds;) {
  }
}

TEST(Profile, AScopeInsideAnotherTakesItsTimeFromIt) {
  take_account();
  {
    const PhaseScope outer(Phase::Align);
    work(0.02);
    {
      const PhaseScope inner(Phase::Factor);
      work(0.04);
    }
    work(0.01);
  }
  work(0.02);
  const Account account = take_account();
  EXPECT_NEAR(spent(account, Phase::Align), 0.03, 0.005);
  EXPECT_NEAR(spent(account, Phase::Factor), 0.04, 0.005);
  EXPECT_NEAR(spent(account, Phase::Other), 0.02, 0.005);
  EXPECT_EQ(spent(account, Phase::Solve), 0);
}

TEST(Profile, AnAccountIsTakenOnce) {
  account_step(0.5);
  take_account();
  const Account account = take_account();
  EXPECT_LT(spent(account, Phase::Other), 0.01);
  EXPECT_EQ(account.steps, 0);
}

TEST(Profile, WhatThreadsDoBelongsToThePhaseThatAskedThem) {
  take_account();
  {
    const PhaseScope scope(Phase::Pack);
    parallel_ranges(4, 4, 1, [](int begin, int end) {
      for (int k = begin; k < end; ++k) {
        work(0.01);
        const PhaseScope inner(Phase::Solve);
        work(0.02);
        account_step(0.25 * k);
      }
    });
  }
  const Account account = take_account();
  EXPECT_NEAR(spent(account, Phase::Pack), 0.04, 0.01);
  EXPECT_NEAR(spent(account, Phase::Solve), 0.08, 0.01);
  EXPECT_EQ(account.steps, 4);
  EXPECT_DOUBLE_EQ(account.fractions, 1.5);
}

TEST(Profile, EveryPhaseHasANameOfItsOwn) {
  std::set<std::string> names;
  for (int k = 0; k < kPhases; ++k) names.insert(to_string(static_cast<Phase>(k)));
  EXPECT_EQ(names.size(), static_cast<std::size_t>(kPhases));
}

}  // namespace
}  // namespace atlas_refine
