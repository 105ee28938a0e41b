// worldy prefetch, and worldy fly with prefetching, on a small planet and simulated disks.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tests/program/small_planet.h"

namespace worldy {
namespace {

using testing::HasSubstr;

class PrefetchCommand : public testing::Test {
protected:
    void SetUp() override {
        bakePlanet(folder);
        std::ofstream(folder.path() / "across.toml") << "name = \"Across\"\n"
                                                        "[[key]]\ntime_s = 0\nlatitude_deg = 10\n"
                                                        "longitude_deg = 20\naltitude_m = 30000\n"
                                                        "heading_deg = 90\npitch_deg = -20\n"
                                                        "[[key]]\ntime_s = 6\nlatitude_deg = 12\n"
                                                        "longitude_deg = 60\naltitude_m = 20000\n"
                                                        "heading_deg = 90\npitch_deg = -20\n";
    }
    nlohmann::json report(const std::string& command) {
        const Ran ran =
            runWorldy(folder, command + " planet.chk --flight across.toml --tau 0.5 --json " + disk);
        EXPECT_EQ(ran.exitCode, 0) << ran.errors;
        return nlohmann::json::parse(ran.output);
    }

    const std::string disk = "--size 640x400 --set bad_disk.latency_ms=40 --set paging.prefetch_horizon_s=3";
    const TemporaryFolder folder;
};

TEST_F(PrefetchCommand, LessIsLateWithPrefetchingAndTheRatiosCompareWithOff) {
    const nlohmann::json all = report("prefetch --disk-mb-s 8 --speeds 1,2");
    ASSERT_EQ(all["flights"].size(), 6u);
    for (std::size_t speed = 0; speed < 2; ++speed) {
        const nlohmann::json& off = all["flights"][3 * speed];
        EXPECT_EQ(off["prefetch"], "off");
        EXPECT_EQ(off["late_ratio"], 1);
        EXPECT_EQ(off["prefetched_blocks"], 0);
        EXPECT_GT(off["late_chunk_s"], 0);
        for (std::size_t mode = 1; mode < 3; ++mode) {
            const nlohmann::json& on = all["flights"][3 * speed + mode];
            EXPECT_EQ(on["prefetch"], mode == 1 ? "motion" : "announced");
            EXPECT_EQ(on["speed"], speed + 1);
            EXPECT_LT(on["late_ratio"], 1);
            EXPECT_NEAR(on["late_ratio"],
                        on["late_chunk_s"].get<double>() / off["late_chunk_s"].get<double>(), 1e-9);
            EXPECT_NEAR(on["bytes_ratio"], on["bytes_read"].get<double>() / off["bytes_read"].get<double>(),
                        1e-9);
            EXPECT_GT(on["prefetch_hits"], 0);
            EXPECT_EQ(on["prefetched_blocks"].get<int>(), on["prefetch_hits"].get<int>() +
                                                              on["prefetch_waste"].get<int>() +
                                                              on["prefetch_unused"].get<int>());
        }
    }
}

TEST_F(PrefetchCommand, TheTableIsTheSameOnEveryRunAndInEveryOrder) {
    const nlohmann::json all = report("prefetch --disk-mb-s 8,4 --speeds 1");
    EXPECT_EQ(report("prefetch --disk-mb-s 8,4 --speeds 1"), all);
    const nlohmann::json reversed = report("prefetch --disk-mb-s 4,8 --speeds 1");
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(reversed["flights"][3 + i], all["flights"][i]);
}

TEST_F(PrefetchCommand, WritesACsvTableAndPrintsOneLineAFlight) {
    const Ran ran = runWorldy(folder,
                              "prefetch planet.chk --flight across.toml --predict motion --disk-ms 10,20 "
                              "--disk-mb-s 8 --speeds 1 --horizons-s 1,2 -o t.csv " +
                                  disk);
    ASSERT_EQ(ran.exitCode, 0) << ran.errors;
    EXPECT_EQ(std::count(ran.output.begin(), ran.output.end(), '\n'), 5) << ran.output;
    const std::string csv = contentOf(folder.path() / "t.csv");
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 5) << csv;
    EXPECT_THAT(csv, HasSubstr("late_chunk_s"));
    EXPECT_THAT(csv, HasSubstr("\n2,motion,2,1,20,8,1,"));
}

TEST_F(PrefetchCommand, AFlightReportsHitsAndWaste) {
    const nlohmann::json off = report("fly --step-s 0.05 --set paging.simulated=true");
    const nlohmann::json on = report("fly --step-s 0.05 --set paging.simulated=true --prefetch announced");
    EXPECT_EQ(off["frame"].back()["prefetched_blocks"], 0);
    EXPECT_GT(off["late_chunk_s"], 0);
    EXPECT_LT(on["late_chunk_s"], off["late_chunk_s"]);
    EXPECT_GT(on["frame"].back()["prefetch_hits"], 0);
    EXPECT_GT(on["frame"].back()["prefetched_bytes"], 0);
}

TEST_F(PrefetchCommand, SaysWhatIsWrongWithItsInput) {
    const auto errorOf = [&](const std::string& options) {
        const Ran ran = runWorldy(folder, "prefetch planet.chk --flight across.toml " + options);
        EXPECT_EQ(ran.exitCode, 2);
        return ran.errors;
    };
    EXPECT_THAT(errorOf("--predict never"), HasSubstr("--predict"));
    EXPECT_THAT(errorOf("--speeds 0"), HasSubstr("--speeds"));
    EXPECT_THAT(errorOf("--predict motion,motion"), HasSubstr("given twice"));
    EXPECT_THAT(errorOf("-o table.txt"), HasSubstr("table.txt"));
}

}  // namespace
}  // namespace worldy
