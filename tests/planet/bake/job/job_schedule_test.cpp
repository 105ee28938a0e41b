#include "planet/bake/job/job_schedule.h"

#include <gtest/gtest.h>

#include <vector>

namespace planet {
namespace {

// A job of equal units that costs nothing but baking.
JobSchedule equalUnits(std::size_t units, const Cluster& cluster) {
    const std::vector<UnitCost> costs(units, {1.0, 0});
    return scheduleJob({costs}, cluster);
}

TEST(JobSchedule, aJobOfOneRankTakesTheSumOfItsUnits) {
    const JobSchedule schedule = equalUnits(100, {.ranks = 1, .answerS = 0});
    EXPECT_DOUBLE_EQ(schedule.totalS, 100);
    EXPECT_DOUBLE_EQ(schedule.efficiency, 1);
    EXPECT_DOUBLE_EQ(schedule.idleS, 0);
}

TEST(JobSchedule, ThreadsShareTheUnitsOfARank) {
    EXPECT_DOUBLE_EQ(equalUnits(100, {.ranks = 1, .threads = 4, .answerS = 0}).totalS, 25);
}

TEST(JobSchedule, EqualUnitsThatDivideEvenlyLeaveNoRankIdle) {
    const JobSchedule schedule = equalUnits(6400, {.ranks = 64, .answerS = 0});
    EXPECT_GT(schedule.efficiency, 0.98);
    EXPECT_GE(schedule.totalS, 100);
}

TEST(JobSchedule, FewerUnitsThanRanksLeaveTheOthersIdle) {
    const JobSchedule schedule = equalUnits(3, {.ranks = 12, .answerS = 0});
    EXPECT_DOUBLE_EQ(schedule.totalS, 1);
    EXPECT_DOUBLE_EQ(schedule.efficiency, 0.25);
    EXPECT_DOUBLE_EQ(schedule.idleS, 0.75);
}

// A unit that takes as long as all others bounds the job.
TEST(JobSchedule, ALongUnitIsSeen) {
    std::vector<UnitCost> costs(100, {1.0, 0});
    costs[99].seconds = 100;
    const JobSchedule schedule = scheduleJob({costs}, {.ranks = 10, .answerS = 0});
    EXPECT_GE(schedule.totalS, 100);
    EXPECT_LT(schedule.efficiency, 0.2);
}

TEST(JobSchedule, WhatEachRankDoesForItselfDoesNotShrink) {
    const std::vector<UnitCost> costs(1000, {1.0, 0});
    const JobSchedule schedule =
        scheduleJob({.units = costs, .openS = 10, .surveyS = 200, .joinS = 50}, {.ranks = 100, .answerS = 0});
    EXPECT_DOUBLE_EQ(schedule.openS, 10 + 2);
    EXPECT_DOUBLE_EQ(schedule.joinS, 0.5);
    EXPECT_NEAR(schedule.efficiency, 10 / (10 + 12 + 0.5), 0.02);
}

TEST(JobSchedule, ASlowFileSystemBoundsTheJob) {
    const std::vector<UnitCost> costs(1000, {1.0, 1'000'000});
    const JobSchedule fast = scheduleJob({costs}, {.ranks = 100, .bytesPerS = 1e12});
    const JobSchedule slow = scheduleJob({costs}, {.ranks = 100, .bytesPerS = 1e7});
    EXPECT_LT(fast.bytesS, 0.01);
    // Written once while it bakes, read and written again at the end.
    EXPECT_NEAR(slow.totalS, 300, 1);
}

}  // namespace
}  // namespace planet
