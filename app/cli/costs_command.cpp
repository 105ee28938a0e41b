#include "app/cli/costs_command.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/base/message.h"
#include "app/base/report.h"
#include "app/measure/surface_costs.h"
#include "app/scene/frame_report.h"
#include "app/scene/offscreen.h"

namespace worldy {

namespace {

using planet::Result;

nlohmann::ordered_json reportOf(const std::vector<PartCost>& costs, const SettledView& at,
                                const CostsOptions& options) {
    nlohmann::ordered_json report = {
        {"file", options.file.string()},      {"width_px", options.size.widthPx},
        {"height_px", options.size.heightPx}, {"rounds", options.rounds},
        {"camera", poseJson(at.pose)},        {"parts", nlohmann::ordered_json::array()}};
    for (const PartCost& cost : costs)
        report["parts"].push_back(
            {{"part", cost.part}, {"without_ms", cost.withoutMs}, {"with_ms", cost.withMs}});
    return report;
}

void print(const std::vector<PartCost>& costs) {
    fmt::print("{:<20} {:>11} {:>9} {:>14} {:>7}\n", "part", "without, ms", "with, ms", "difference, ms",
               "ratio");
    for (const PartCost& cost : costs)
        fmt::print("{:<20} {:>11.2f} {:>9.2f} {:>14.2f} {:>7.2f}\n", cost.part, cost.withoutMs, cost.withMs,
                   cost.withMs - cost.withoutMs, cost.withMs / cost.withoutMs);
}

}  // namespace

Result<void> runCosts(const CostsOptions& options) {
    const Result<std::filesystem::path> colour = colourImageToDraw(options.file, options.colourImage);
    if (!colour) return tl::unexpected(colour.error());
    const SceneConfig config{options.file, {}, *colour};
    // The data for all features is loaded first.
    const ViewSettings all = partsOf(options.view, {}).back().settings;
    Result<Offscreen> offscreen = openOffscreen(config, all, options.size, 1);
    if (!offscreen) return tl::unexpected(offscreen.error());
    // Some of the costs are measured without the planet's own colours.
    if (Result<void> read = readColourImage(offscreen->scene); !read) return read;
    const double radiusM = offscreen->scene.planet->tree().shape.radiusM;
    const SettledView at =
        settleAt(*offscreen, options.camera.value_or(startPose(options.start, radiusM)), all);
    if (!at.settled) printMessage("worldy: loading timed out; chunks are missing\n");
    Result<CostMeter> meter = CostMeter::create(offscreen->scene, at.view, options.view, options.rounds);
    if (!meter) return tl::unexpected(meter.error());
    while (meter->step(offscreen->scene)) {
    }
    const std::vector<PartCost> costs = meter->costs();
    if (!options.report.json) print(costs);
    return writeReport(options.report, reportOf(costs, at, options));
}

}  // namespace worldy
