// Compares two reports of worldy bench, row by row.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "app/bench/bench_parts.h"
#include "planet/base/result.h"

namespace worldy {

// A row of the report of a part of the benchmark.
struct ReportedRow {
    std::string part;
    BenchRow row;
};
// Reads a report that worldy bench wrote as JSON. The Error names the file and what is wrong in it.
planet::Result<std::vector<ReportedRow>> readBenchReport(const std::filesystem::path& file);

enum class BenchVerdict : std::uint8_t {
    WithinNoise,  // the ranges over the rounds overlap
    Better,
    Worse,
    Differs,  // a count, of which neither more nor less is better
};

// A row that both reports have. What has a yardstick is compared by its ratio to it, because other load on the machine
// slows both. The rest is compared by its value.
struct BenchChange {
    ReportedRow of;
    bool isRatio = false;
    Spread a;
    Spread b;
    double factor = 1;  // median of b over median of a
    BenchVerdict verdict = BenchVerdict::WithinNoise;
};

struct BenchComparison {
    std::vector<BenchChange> changes;
    std::vector<ReportedRow> onlyA;
    std::vector<ReportedRow> onlyB;
};
BenchComparison compareBenchReports(const std::vector<ReportedRow>& a, const std::vector<ReportedRow>& b);

}  // namespace worldy
