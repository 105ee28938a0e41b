#include "app/scene/frame_report.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace worldy {

namespace {

TEST(FrameReport, totalsOfBlocksAreGivenPerKind) {
    FrameStats stats;
    stats.paging[planet::BlockKind::Heights] = {.loaded = 1, .evicted = 2, .failed = 3, .bytesRead = 100};
    stats.paging[planet::BlockKind::Colours] = {.loaded = 4, .evicted = 5, .failed = 6, .bytesRead = 20};
    stats.paging[planet::BlockKind::Normals] = {.loaded = 7, .evicted = 8, .failed = 9, .bytesRead = 3};
    const nlohmann::ordered_json report = statsJson(stats);
    using Json = nlohmann::ordered_json;
    EXPECT_EQ(report["loaded_blocks"], (Json{{"heights", 1}, {"colours", 4}, {"normals", 7}}));
    EXPECT_EQ(report["evicted_blocks"], (Json{{"heights", 2}, {"colours", 5}, {"normals", 8}}));
    EXPECT_EQ(report["failed_reads"], (Json{{"heights", 3}, {"colours", 6}, {"normals", 9}}));
    EXPECT_EQ(report["bytes_read"], 123);
}

TEST(FrameReport, budgetsAreGivenIfOneIsOn) {
    FrameStats stats;
    stats.tauPx = 3;
    EXPECT_FALSE(statsJson(stats).contains("tau_px"));
    stats.budget = {.isOn = true, .isMeasured = true, .binds = planet::GovernorBudget::GpuTime, .use = 0.9};
    const nlohmann::ordered_json report = statsJson(stats);
    EXPECT_EQ(report["tau_px"], 3);
    EXPECT_EQ(report["budget_use"], 0.9);
    EXPECT_EQ(report["budget_binds"], "gpu_time");
}

}  // namespace

}  // namespace worldy
