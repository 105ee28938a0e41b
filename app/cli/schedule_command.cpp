#include "app/cli/schedule_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <system_error>

#include "app/base/output_file.h"
#include "planet/bake/job/job_schedule.h"

namespace worldy {

namespace {

using planet::Result;

// The costs of the bake that a report tells of.
struct ReportedCosts {
    std::vector<planet::UnitCost> units;
    double openS = 0;
    double surveyS = 0;
    double joinS = 0;
};

bool isCost(const nlohmann::json& value) {
    return value.is_number() && value.get<double>() >= 0 && value.get<double>() < 1e15;
}

Result<ReportedCosts> readCosts(const std::filesystem::path& file) {
    const auto refused = [&](const char* problem) {
        return planet::badInput(
            fmt::format("{}: {}; expected what worldy bake --json prints, run with --resume or on "
                        "several ranks",
                        file.string(), problem));
    };
    constexpr std::size_t mostBytes = std::size_t{256} << 20;
    std::error_code status;
    if (!std::filesystem::is_regular_file(file, status)) return refused("is no file");
    const std::string text = startOfFile(file, mostBytes);
    const nlohmann::json report = nlohmann::json::parse(text, nullptr, false);
    if (!report.is_object()) return refused("is not a report");
    for (const char* name : {"finished_units", "ranks"}) {
        if (!report.contains(name) || !report[name].is_array() || report[name].empty())
            return refused("has no finished units");
    }
    ReportedCosts costs;
    for (const nlohmann::json& unit : report["finished_units"]) {
        if (!unit.is_array() || unit.size() != 3 || !std::ranges::all_of(unit, isCost))
            return refused("has a unit that is not its samples, seconds and bytes");
        costs.units.push_back({unit[1].get<double>(), static_cast<std::uint64_t>(unit[2].get<double>())});
    }
    for (const char* name : {"open_s", "plan_s"}) {
        if (!report.contains(name) || !isCost(report[name]))
            return refused("does not say how long it took to begin");
        costs.openS += report[name].get<double>();
    }
    double longestSurveyS = 0;
    for (const nlohmann::json& rank : report["ranks"]) {
        for (const char* name : {"survey_s", "join_s", "threads"}) {
            if (!rank.is_object() || !isCost(rank.value(name, nlohmann::json())))
                return refused("has a rank that does not say how long it read the source and joined");
        }
        const double threads = rank["threads"].get<double>();
        longestSurveyS = std::max(longestSurveyS, rank["survey_s"].get<double>());
        costs.surveyS += rank["survey_s"].get<double>() * threads;
        costs.joinS += rank["join_s"].get<double>() * threads;
    }
    costs.openS = std::max(costs.openS - longestSurveyS, 0.0);
    return costs;
}

nlohmann::ordered_json jsonOf(const planet::Cluster& cluster, const planet::JobSchedule& schedule) {
    return {{"ranks", cluster.ranks},           {"total_s", schedule.totalS},
            {"open_s", schedule.openS},         {"bake_s", schedule.bakeS},
            {"idle_s", schedule.idleS},         {"join_s", schedule.joinS},
            {"file_system_s", schedule.bytesS}, {"efficiency", schedule.efficiency}};
}

}  // namespace

Result<void> runSchedule(const ScheduleOptions& options) {
    const Result<ReportedCosts> costs = readCosts(options.file);
    if (!costs) return tl::unexpected(costs.error());
    nlohmann::ordered_json report = {{"file", options.file.string()},
                                     {"units", costs->units.size()},
                                     {"threads", options.threads},
                                     {"megabytes_per_s", options.megabytesPerS},
                                     {"schedules", nlohmann::ordered_json::array()}};
    if (!options.report.json) {
        fmt::print("{} units; ranks of {} threads; a file system of {:g} MB/s\n", costs->units.size(),
                   options.threads, options.megabytesPerS);
        fmt::print("{:>6} {:>12} {:>11} {:>10} {:>10} {:>10} {:>10} {:>12}\n", "ranks", "efficiency",
                   "total, s", "open, s", "bake, s", "idle, s", "join, s", "of it I/O, s");
    }
    for (const int ranks : options.ranks) {
        const planet::Cluster cluster{
            .ranks = ranks, .threads = options.threads, .bytesPerS = options.megabytesPerS * 1e6};
        const planet::JobSchedule schedule =
            planet::scheduleJob({costs->units, costs->openS, costs->surveyS, costs->joinS}, cluster);
        report["schedules"].push_back(jsonOf(cluster, schedule));
        if (options.report.json) continue;
        fmt::print("{:>6} {:>10.1f} % {:>11.1f} {:>10.1f} {:>10.1f} {:>10.2f} {:>10.1f} {:>12.1f}\n", ranks,
                   100 * schedule.efficiency, schedule.totalS, schedule.openS, schedule.bakeS, schedule.idleS,
                   schedule.joinS, schedule.bytesS);
    }
    return writeReport(options.report, report);
}

}  // namespace worldy
