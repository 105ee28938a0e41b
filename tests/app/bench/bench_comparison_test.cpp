#include "app/bench/bench_comparison.h"

#include <gmock/gmock.h>

#include <fstream>

#include "tests/support/temporary_folder.h"

namespace worldy {
namespace {

using testing::HasSubstr;

ReportedRow row(const std::string& subject, const std::string& unit, Spread value) {
    return {"part", {subject, "quantity", unit, value}};
}

ReportedRow ratioRow(const std::string& subject, const std::string& unit, Spread value, Spread ratio) {
    ReportedRow made = row(subject, unit, value);
    made.row.ratio = ratio;
    made.row.yardstick = "plain";
    return made;
}

BenchVerdict verdict(const std::string& unit, Spread a, Spread b) {
    return compareBenchReports({row("s", unit, a)}, {row("s", unit, b)}).changes.at(0).verdict;
}

TEST(BenchComparison, whatOverlapsIsWithinTheNoise) {
    EXPECT_EQ(verdict("ms", {10, 9, 12}, {11, 10, 13}), BenchVerdict::WithinNoise);
    EXPECT_EQ(verdict("ms", {10, 9, 12}, {12, 12, 13}), BenchVerdict::WithinNoise);
    EXPECT_EQ(verdict("ms", {10, 10, 10}, {10, 10, 10}), BenchVerdict::WithinNoise);
}

TEST(BenchComparison, moreTimeIsWorseAndMoreRateIsBetter) {
    EXPECT_EQ(verdict("ms", {10, 9, 12}, {13, 12.1, 14}), BenchVerdict::Worse);
    EXPECT_EQ(verdict("ms", {10, 9, 12}, {8, 7, 8.9}), BenchVerdict::Better);
    EXPECT_EQ(verdict("MB/s", {10, 9, 12}, {13, 12.1, 14}), BenchVerdict::Better);
    EXPECT_EQ(verdict("MB/s", {10, 9, 12}, {8, 7, 8.9}), BenchVerdict::Worse);
    EXPECT_EQ(verdict("", {10, 10, 10}, {11, 11, 11}), BenchVerdict::Differs);
}

TEST(BenchComparison, aRatioIsComparedWhereThereIsAYardstick) {
    // The second run was on a machine that is twice as slow, and nothing changed.
    const BenchComparison same = compareBenchReports({ratioRow("s", "ms", {10, 9, 11}, {1.5, 1.4, 1.6})},
                                                     {ratioRow("s", "ms", {20, 19, 21}, {1.5, 1.45, 1.6})});
    EXPECT_EQ(same.changes.at(0).verdict, BenchVerdict::WithinNoise);
    EXPECT_DOUBLE_EQ(same.changes.at(0).factor, 1);
    const BenchComparison slower = compareBenchReports({ratioRow("s", "ms", {10, 9, 11}, {1.5, 1.4, 1.6})},
                                                       {ratioRow("s", "ms", {10, 9, 11}, {1.8, 1.7, 1.9})});
    EXPECT_EQ(slower.changes.at(0).verdict, BenchVerdict::Worse);
    EXPECT_DOUBLE_EQ(slower.changes.at(0).factor, 1.2);
}

TEST(BenchComparison, rowsOfOneReportAreListed) {
    const BenchComparison comparison =
        compareBenchReports({row("both", "ms", {1, 1, 1}), row("gone", "ms", {1, 1, 1})},
                            {row("new", "ms", {1, 1, 1}), row("both", "ms", {1, 1, 1})});
    ASSERT_EQ(comparison.changes.size(), 1u);
    ASSERT_EQ(comparison.onlyA.size(), 1u);
    EXPECT_EQ(comparison.onlyA[0].row.subject, "gone");
    ASSERT_EQ(comparison.onlyB.size(), 1u);
    EXPECT_EQ(comparison.onlyB[0].row.subject, "new");
}

std::string problemIn(const std::string& text) {
    const tests::TemporaryFolder folder;
    std::ofstream(folder / "report.json") << text;
    const auto read = readBenchReport(folder / "report.json");
    EXPECT_FALSE(read) << text;
    return read ? "" : read.error().message;
}

TEST(BenchReport, whatIsNoReportIsRefused) {
    for (const char* const text : {"", "[]", "{", R"({"parts": 3})", "{}"})
        EXPECT_THAT(problemIn(text), HasSubstr("report.json: is not a report of a benchmark; expected"));
    EXPECT_THAT(problemIn(R"({"schema_version": 1, "parts": {}})"),
                HasSubstr("schema_version is 1; expected"));
    EXPECT_THAT(readBenchReport("/nonexistent/a.json").error().message,
                HasSubstr("/nonexistent/a.json: is no file"));
}

TEST(BenchReport, anIncompleteRowIsRefused) {
    for (const char* const row :
         {"3", "{}", R"({"subject":"s","quantity":"q","unit":"ms","median":1,"minimum":2,"maximum":3})",
          R"({"subject":"s","quantity":"q","unit":"ms","median":0,"minimum":0,"maximum":0})",
          R"({"subject":"s","quantity":"q","unit":"ms","median":"1","minimum":1,"maximum":1})",
          R"({"subject":"s","quantity":"q","unit":"ms","median":1,"minimum":1,"maximum":1,"times":{}})"}) {
        EXPECT_THAT(problemIn(R"({"schema_version": 2, "parts": {"bake": [)" + std::string(row) + "]}}"),
                    HasSubstr("a row of bake is incomplete; expected"));
    }
}

}  // namespace
}  // namespace worldy
