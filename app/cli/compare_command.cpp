#include "app/cli/compare_command.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "app/base/interrupt.h"
#include "app/base/picture_file.h"
#include "app/base/report.h"
#include "app/base/text.h"
#include "app/flight/flight_path_file.h"
#include "app/measure/comparison.h"
#include "app/settings/settings_text.h"

namespace worldy {

namespace {

using Json = nlohmann::ordered_json;
using planet::Result;

constexpr double pictureGain = 8;

// Returns the settings that differ as flown; settings that the flight ignores make no difference.
std::vector<SettingDifference> differencesOf(const ComparisonPlan& plan) {
    Settings a, b;
    a.view = flownSide(plan, 0).settings;
    b.view = flownSide(plan, 1).settings;
    return differences(a, b);
}

void printTable(const ComparisonPlan& plan, std::span<const SettingDifference> different,
                const ComparedPair& pair) {
    fmt::print("{}: {} frames\n", plan.path.name, plan.moments);
    if (plan.sides[0].chunkFile != plan.sides[1].chunkFile) {
        fmt::print("A is {}, B is {}\n", plan.sides[0].chunkFile.string(), plan.sides[1].chunkFile.string());
    }
    if (different.empty()) fmt::print("equal settings\n");
    for (const SettingDifference& one : different) {
        const auto [a, b] = shortNumberTexts(one.here, one.there);
        fmt::print("{}: A {}, B {}\n", one.setting, a, b);
    }
    fmt::print("\n{:<18}{:>14}{:>14}{:>14}\n", "", "A", "B", "B / A");
    for (const CompareRow& row : compareRows()) {
        if (!row.flight) continue;
        const std::optional<double>& a = pair[0].*row.value;
        const std::optional<double>& b = pair[1].*row.value;
        fmt::print("{:<18}{:>14}{:>14}{:>14}\n", row.name, figureText(row, a), figureText(row, b),
                   changeText(row, a, b));
    }
}

Json jsonOf(const ComparedSide& side, const ComparedFigures& figures) {
    Json json = {{"file", side.chunkFile.string()}};
    for (const CompareRow& row : compareRows()) {
        if (!row.flight) continue;
        const std::optional<double>& value = figures.*row.value;
        if (value && row.whole)
            json[row.key] = std::llround(*value);
        else
            json[row.key] = value ? Json(*value) : Json(nullptr);
    }
    return json;
}

Json reportOf(const ComparisonPlan& plan, std::span<const SettingDifference> different,
              const ComparedPair& pair, const std::optional<ComparedPictures>& pictures) {
    Json report = {{"flight", plan.path.name},           {"frames", plan.moments},
                   {"width_px", plan.size.widthPx},      {"height_px", plan.size.heightPx},
                   {"pops_step_s", plan.popStepS},       {"a", jsonOf(plan.sides[0], pair[0])},
                   {"b", jsonOf(plan.sides[1], pair[1])}};
    report["settings"] = Json::array();
    for (const SettingDifference& one : different)
        report["settings"].push_back({{"setting", one.setting}, {"a", one.here}, {"b", one.there}});
    if (pictures) {
        report["most_different"] = {{"time_s", pictures->timeS},
                                    {"pixels", pictures->pixels},
                                    {"largest_steps", pictures->largestSteps}};
    }
    return report;
}

Result<void> writePictures(const std::filesystem::path& folder, const ComparedPictures& pictures) {
    std::error_code problem;
    std::filesystem::create_directories(folder, problem);  // if this fails, writing reports it
    const Result<void> beside =
        writePicture(besideEachOther(pictures.a, pictures.b), folder / "side_by_side.png");
    if (!beside) return beside;
    return writePicture(differenceOf(pictures.a, pictures.b, pictureGain), folder / "difference.png");
}

Result<ComparisonPlan> planOf(const CompareOptions& options) {
    Result<FlightPath> path = loadFlightPath(options.flight);
    if (!path) return tl::unexpected(path.error());
    ComparisonPlan plan;
    plan.path = std::move(*path);
    const Result<FlightFrames> frames = framesOf(plan.path, options.sampling, mostFlightViews);
    if (!frames) return tl::unexpected(frames.error());
    plan.moments = frames->count;
    plan.momentStepS = frames->stepS;
    plan.size = options.size;
    plan.sides[0] = {options.file, options.settings[0]};
    plan.sides[1] = {options.fileOfB.empty() ? options.file : options.fileOfB, options.settings[1]};
    return plan;
}

}  // namespace

Result<void> runCompare(const CompareOptions& options) {
    const Result<ComparisonPlan> plan = planOf(options);
    if (!plan) return tl::unexpected(plan.error());
    const InterruptWatch watch;
    const auto goOn = [&](double) { return !watch.interrupted(); };
    const Result<ComparedPair> pair = compareOverFlight(*plan, goOn);
    if (!pair) return tl::unexpected(pair.error());
    const std::vector<SettingDifference> different = differencesOf(*plan);
    if (!options.report.json) printTable(*plan, different, *pair);
    std::optional<ComparedPictures> pictures;
    if (!options.pictures.empty()) {
        Result<ComparedPictures> taken = compareInPictures(*plan, goOn);
        if (!taken) return tl::unexpected(taken.error());
        pictures = std::move(*taken);
        if (!options.report.json) {
            fmt::print("\nmost differing frame: {} pixels at {:.2f} s, max difference {} of 255\n",
                       pictures->pixels, pictures->timeS, pictures->largestSteps);
        }
        if (const Result<void> written = writePictures(options.pictures, *pictures); !written) return written;
    }
    return writeReport(options.report, reportOf(*plan, different, *pair, pictures));
}

}  // namespace worldy
