// The schedule's rules, one by one.
#include "reduce/schedule.h"

#include <gtest/gtest.h>

namespace atlas_refine {
namespace {

ScheduleView below(double deficit) { return {.bounded = true, .deficit = deficit, .energy = 1.01, .range = 0.0025}; }

TEST(Schedule, ClimbsFasterFarBelowTheTarget) {
  EXPECT_DOUBLE_EQ(largest_climb(0.001), 0.01);
  EXPECT_DOUBLE_EQ(largest_climb(0.1), 0.02);
  EXPECT_DOUBLE_EQ(largest_climb(1), 0.03);
}

TEST(Schedule, SoftensFromTheTargetOnAndNotBefore) {
  Schedule schedule = first_schedule(false, below(0.2), 1);
  const double firm = schedule.firmness;
  adapt(schedule, below(0.1), 0.01, 1);
  EXPECT_EQ(schedule.firmness, firm);
  EXPECT_FALSE(schedule.arrived);
  adapt(schedule, below(1e-4), 0.01, 1);
  EXPECT_LT(schedule.firmness, firm);
  for (int k = 0; k < 20; ++k) adapt(schedule, below(0.01), 0.01, 1);  // a dip does not hold it up
  EXPECT_TRUE(settled(schedule, below(0.01), 0.01));
}

TEST(Schedule, AWarmStartIsAsSoftAsAnEnd) {
  Schedule end = first_schedule(false, below(0.2), 1);
  for (int k = 0; k < 40; ++k) adapt(end, below(1e-5), 0.02, 1);
  const Schedule warm = warm_schedule(0.02, below(0));
  EXPECT_DOUBLE_EQ(warm.stiffness, end.stiffness);
  EXPECT_TRUE(settled(warm, below(0), 0.02));
}

TEST(Schedule, StiffnessFollowsThePriceByAFactorOfTwoAtMost) {
  Schedule schedule = first_schedule(false, below(0.2), 1);
  const double before = schedule.stiffness;
  adapt(schedule, below(0.2), 100, 1);
  EXPECT_DOUBLE_EQ(schedule.stiffness, 2 * before);
  adapt(schedule, below(0.2), 0, 1);
  EXPECT_DOUBLE_EQ(schedule.stiffness, before);
}

TEST(Schedule, DampingFollowsTheSteps) {
  Schedule schedule = first_schedule(false, below(0.2), 1);
  const double before = schedule.damping;
  adapt(schedule, below(0.2), 0, 0.05);
  EXPECT_DOUBLE_EQ(schedule.damping, 4 * before);
  adapt(schedule, below(0.2), 0, 0.3);
  EXPECT_DOUBLE_EQ(schedule.damping, 4 * before);
  adapt(schedule, below(0.2), 0, 1);
  EXPECT_DOUBLE_EQ(schedule.damping, 2 * before);
}

TEST(Schedule, APerfectStartIsNotWedgedByRounding) {
  Schedule schedule;
  schedule.relaxing = true;
  EXPECT_FALSE(wedged(schedule, 1, 1 - 1e-16));
  EXPECT_FALSE(wedged(schedule, 1.01, 1.005));
  EXPECT_TRUE(wedged(schedule, 1.1, 1.005));
  schedule.relaxing = false;
  EXPECT_FALSE(wedged(schedule, 1.1, 1.005));
}

TEST(Schedule, AStartAtTheFloorIsPushedOffIt) {
  const ScheduleView view{.bounded = true, .deficit = -0.05, .energy = 1.1, .range = 0.0025};
  EXPECT_GT(first_schedule(true, view, 1e-9).stiffness, 1e-4 * first_schedule(true, view, 1).stiffness);
}

TEST(Schedule, TheMarginFollowsTheErrorAndIsBounded) {
  Schedule schedule;
  adapt_margin(schedule, 1);
  EXPECT_DOUBLE_EQ(schedule.margin, kMostMargin);
  adapt_margin(schedule, 0);
  EXPECT_DOUBLE_EQ(schedule.margin, 0.5 * kMostMargin);
}

TEST(Schedule, BelowTheTargetPeIsWorthLittleDistortion) {
  EXPECT_GT(worth_below_target(0.9, 1.03, 1), worth_below_target(0.89, 1, 1));   // the first per cent are nearly free
  EXPECT_GT(worth_below_target(0.9, 1.2, 1), worth_below_target(0.8, 1, 1));     // a good deal of PE is worth some
  EXPECT_LT(worth_below_target(0.91, 1.5, 1), worth_below_target(0.9, 1.1, 1));  // the last per cent are not
  EXPECT_LT(worth_below_target(0.99, 10, 1), worth_below_target(0.1, 1, 1));
  // Charts that came distorted are measured by their own least.
  EXPECT_DOUBLE_EQ(worth_below_target(0.8, 6, 5), worth_below_target(0.8, 1.2, 1));
}

}  // namespace
}  // namespace atlas_refine
