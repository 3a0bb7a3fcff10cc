// Progress, cancellation and exceptions across the worker thread.
#include "support/monitor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>
#include <vector>

#include "atlas_refine/error.h"

namespace atlas_refine {
namespace {

void wait_ms(int milliseconds) { std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds)); }

/// Two stages of reports that also go back; about 0.6 s.
void work_of_two_stages(Monitor& monitor) {
  monitor.begin_stage("first", 0, 0.4);
  for (const double fraction : {0.0, 0.5, 0.2, 1.5, -1.0}) {
    monitor.report(fraction, 0.7);
    wait_ms(60);
  }
  monitor.begin_stage("second", 0.4, 1);
  for (const double fraction : {0.0, 0.3, 0.1, 0.9, 1.0}) {
    monitor.report(fraction, 0.8);
    wait_ms(60);
  }
}

TEST(Monitor, ProgressNeverDecreases) {
  std::vector<Progress> seen;
  run_monitored(
      [&](const Progress& progress) {
        seen.push_back(progress);
        return true;
      },
      work_of_two_stages);
  ASSERT_GT(seen.size(), 4u);
  for (std::size_t k = 0; k < seen.size(); ++k) {
    EXPECT_GE(seen[k].fraction, k == 0 ? 0 : seen[k - 1].fraction);
    EXPECT_LE(seen[k].fraction, 1);
  }
  EXPECT_EQ(seen.back().stage, "second");
  EXPECT_EQ(seen.back().pe, 0.8);
}

TEST(Monitor, StagesCoverTheirPart) {
  Monitor monitor;
  monitor.begin_stage("squeeze", 0.25, 0.75);
  EXPECT_EQ(monitor.snapshot().fraction, 0.25);
  monitor.report(0.5, 0.6);
  EXPECT_EQ(monitor.snapshot().fraction, 0.5);
  monitor.report(0.1, 0.5);
  EXPECT_EQ(monitor.snapshot().fraction, 0.5);
  EXPECT_EQ(monitor.snapshot().pe, 0.5);
}

/// How often work that checks every 10 ms still may go on after the callback has asked it to stop.
int checks_after_asking() {
  std::atomic<bool> asked = false;
  int checks = 0;
  const auto ask = [&](const Progress&) {
    asked = true;
    return false;
  };
  const auto work = [&](Monitor& monitor) {
    for (int k = 0; k < 1000; ++k, wait_ms(10)) {
      monitor.check();
      checks += asked;
    }
    FAIL() << "nobody cancelled";
  };
  try {
    run_monitored(ask, work);
    ADD_FAILURE() << "must throw";
  } catch (const RefineError& error) {
    EXPECT_EQ(error.code(), ErrorCode::Cancelled);
  }
  return checks;
}

TEST(Monitor, CancelsWithinAFifthOfASecond) {
  int fewest = checks_after_asking();
  for (int attempt = 1; attempt < 5; ++attempt)  // the machine may hold the asking thread for a moment
    fewest = std::min(fewest, checks_after_asking());
  EXPECT_LE(fewest, 20);
}

TEST(Monitor, EveryReportThrowsOnceCancelled) {
  Monitor monitor;
  monitor.begin_stage("pack", 0, 1);
  monitor.cancel();
  EXPECT_THROW(monitor.report(0.5), RefineError);
  EXPECT_THROW(monitor.check(), RefineError);
  EXPECT_THROW(monitor.begin_stage("squeeze", 0, 1), RefineError);
}

TEST(Monitor, FinishEndsOnlyWhatIsWorthless) {
  Monitor monitor;
  EXPECT_FALSE(monitor.finishing());
  monitor.finish();
  EXPECT_TRUE(monitor.finishing());
  monitor.report(0.5);
  {
    const Monitor::Worthless plan(monitor);
    EXPECT_THROW(monitor.check(), Monitor::GivenUp);
    EXPECT_THROW(monitor.begin_stage("layout", 0, 1), Monitor::GivenUp);
  }
  monitor.check();
}

TEST(Monitor, TheCallbacksAnswerFinishes) {
  bool finishing = false;
  run_monitored([](const Progress&) { return Answer::Finish; },
                [&](Monitor& monitor) {
                  for (int k = 0; k < 1000 && !finishing; ++k, wait_ms(10)) finishing = monitor.finishing();
                });
  EXPECT_TRUE(finishing);
}

TEST(Monitor, ExceptionsOfEitherSideComeOut) {
  const auto go_on = [](const Progress&) { return true; };
  EXPECT_THROW(run_monitored(go_on, [](Monitor&) { throw std::out_of_range("work"); }), std::out_of_range);
  EXPECT_THROW(run_monitored({}, [](Monitor&) { throw std::out_of_range("work"); }), std::out_of_range);
  bool ended = false;
  const auto fail = [](const Progress&) -> bool { throw std::domain_error("callback"); };
  const auto work = [&](Monitor& monitor) {
    try {
      for (int k = 0; k < 1000; ++k, wait_ms(10)) monitor.report(0.5);
    } catch (...) {
      ended = true;
      throw;
    }
  };
  EXPECT_THROW(run_monitored(fail, work), std::domain_error);
  EXPECT_TRUE(ended);
}

TEST(Monitor, WithoutACallbackTheCallerWorks) {
  std::thread::id worker;
  run_monitored({}, [&](Monitor&) { worker = std::this_thread::get_id(); });
  EXPECT_EQ(worker, std::this_thread::get_id());
}

TEST(Monitor, TheCallbackRunsInTheCallersThread) {
  std::thread::id called = {};
  run_monitored(
      [&](const Progress&) {
        called = std::this_thread::get_id();
        return true;
      },
      [](Monitor&) { wait_ms(200); });
  EXPECT_EQ(called, std::this_thread::get_id());
}

}  // namespace
}  // namespace atlas_refine
