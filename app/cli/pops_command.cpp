#include "app/cli/pops_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/base/interrupt.h"
#include "app/base/message.h"
#include "app/base/report.h"
#include "app/flight/flight_path_file.h"
#include "app/measure/pops_flight.h"
#include "app/scene/frame_report.h"
#include "app/scene/scene_settings.h"
#include "planet/base/percentile.h"

namespace worldy {

namespace {

using Json = nlohmann::ordered_json;
using planet::percentileOf;
using planet::PopEvent;
using planet::Result;

constexpr std::array reportedShares = {0.5, 0.9, 0.99, 1.0};
constexpr std::array<const char*, reportedShares.size()> shareNames = {"p50", "p90", "p99", "maximum"};

// Returns all level changes, worst first; those that do not count come last.
std::vector<const PopEvent*> rankedEvents(const PopsFlight& flown) {
    std::vector<const PopEvent*> ranked;
    for (const PopEvent& event : flown.events) ranked.push_back(&event);
    std::sort(ranked.begin(), ranked.end(),
              [](const PopEvent* a, const PopEvent* b) { return planet::isWorsePop(*a, *b); });
    return ranked;
}

Json jsonOf(const PopEvent& event, double radiusM) {
    return {{"time_s", event.timeS},
            {"chunk", planet::toString(event.chunk)},
            {"from_level", event.fromLevel},
            {"to_level", event.toLevel},
            {"cause", planet::popCauseName(event.cause)},
            {"after_jump", event.afterJump},
            {"under_sea", event.jump.underSea},
            {"outside_picture", event.jump.places == 0 && !event.jump.underSea},
            {"largest_px", event.jump.largestPx},
            {"largest_facing_px", event.jump.largestFacingPx},
            {"mean_px", event.jump.meanPx},
            {"beside_px", event.besidePx},
            {"camera", poseJson(planet::poseFromView(event.view, radiusM))}};
}

Json jsonOf(const PopsOptions& options, const FlightPath& path, double stepS, const PopsFlight& flown,
            double radiusM) {
    Json report = {{"flight", path.name},
                   {"file", options.file.string()},
                   {"frames", flown.frames},
                   {"step_s", stepS},
                   {"width_px", options.size.widthPx},
                   {"height_px", options.size.heightPx},
                   {"tau_px", options.view.lod.tauPx},
                   {"morph", options.view.lod.morph},
                   {"switches", flown.totals.switches},
                   {"counted", flown.totals.counted},
                   {"after_jump", flown.totals.afterJump},
                   {"under_sea", flown.totals.underSea},
                   {"outside_picture", flown.totals.outsidePicture},
                   {"late", flown.totals.late},
                   {"sea_surface_drawn", flown.seaSurfaceDrawn},
                   {"worst_beside_px", flown.totals.worstBesidePx},
                   {"measuring_us_per_switch", flown.usPerSwitch}};
    std::vector<double> jumps = jumpsOf(flown);
    for (std::size_t i = 0; i < reportedShares.size(); ++i)
        report["largest_px_by_percentile"][shareNames[i]] = percentileOf(jumps, reportedShares[i]);
    for (std::size_t i = 0; i < planet::popCauseCount; ++i)
        report["causes"][planet::popCauseName(static_cast<planet::PopCause>(i))] = flown.totals.byCause[i];
    report["events"] = Json::array();
    for (const PopEvent* event : rankedEvents(flown)) report["events"].push_back(jsonOf(*event, radiusM));
    return report;
}

void printSummary(const FlightPath& path, const PopsOptions& options, double stepS, const PopsFlight& flown) {
    std::vector<double> jumps = jumpsOf(flown);
    fmt::print("{}: {} frames, {:.4g} s apart\n", path.name, flown.frames, stepS);
    const planet::PopTotals& totals = flown.totals;
    fmt::print(
        "{} level changes, {:.0f} µs to measure one; {} counted, {} after jump, {} under sea, "
        "{} outside picture\n",
        totals.switches, flown.usPerSwitch, totals.counted, totals.afterJump, totals.underSea,
        totals.outsidePicture);
    fmt::print("sea surface drawn: {}\n",
               flown.seaSurfaceDrawn ? "yes (as with a GPU); it hides the sea bed" : "no");
    for (std::size_t i = 0; i < planet::popCauseCount; ++i) {
        if (flown.totals.byCause[i] == 0) continue;
        fmt::print("  {:18}{:8}\n", planet::popCauseName(static_cast<planet::PopCause>(i)),
                   flown.totals.byCause[i]);
    }
    if (!jumps.empty()) {
        fmt::print(
            "jump of counted level changes: P99 {:.4f} px, median {:.4f}, P90 {:.4f}, max {:.4f} px; "
            "max jump of adjacent edges {:.4f} px\n",
            percentileOf(jumps, 0.99), percentileOf(jumps, 0.5), percentileOf(jumps, 0.9),
            percentileOf(jumps, 1), flown.totals.worstBesidePx);
    }
    std::vector<const PopEvent*> worst = rankedEvents(flown);
    worst.resize(std::min(worst.size(), static_cast<std::size_t>(options.worst)));
    if (worst.empty()) return;
    fmt::print("\n{:>10}  {:22}{:>8}{:>14}{:>14}{:>14}  {:18}{}\n", "time", "chunk", "levels", "largest px",
               "mean px", "adjacent px", "cause", "note");
    for (const PopEvent* event : worst) {
        const std::string note = planet::popNote(*event);
        fmt::print("{:8.2f} s  {:22}{:>8}{:14.4f}{:14.4f}{:14.4f}  {:{}}{}\n", event->timeS,
                   planet::toString(event->chunk), fmt::format("{} > {}", event->fromLevel, event->toLevel),
                   event->jump.largestPx, event->jump.meanPx, event->besidePx,
                   planet::popCauseName(event->cause), note.empty() ? 0 : 18, note);
    }
}

}  // namespace

Result<void> runPops(const PopsOptions& options) {
    const Result<FlightPath> path = loadFlightPath(options.flight);
    if (!path) return tl::unexpected(path.error());
    const Result<FlightFrames> frames = framesOf(*path, options.sampling, mostPopsFrames);
    if (!frames) return tl::unexpected(frames.error());
    if (frames->stepS == 0) return planet::badInput("--frames: 1 is too few for a pop; expected at least 2");
    auto planet = planet::Planet::open(options.file, pagingSettingsOf(options.view));
    if (!planet) return tl::unexpected(planet.error());
    (*planet)->setExaggeration(options.view.surface.exaggeration);
    if (const auto set = (*planet)->setRegions(options.view.regions.applied()); !set)
        return tl::unexpected(set.error());
    const InterruptWatch watch;
    const Result<PopsFlight> flown =
        flyForPops(**planet, *path, options.view, options.size, frames->stepS,
                   /*software=*/false, [&](double) { return !watch.interrupted(); });
    if (!flown) return tl::unexpected(flown.error());
    for (const std::string& problem : (*planet)->takeProblems()) printMessage("worldy: {}\n", problem);
    if (!options.report.json) printSummary(*path, options, frames->stepS, *flown);
    return writeReport(options.report,
                       jsonOf(options, *path, frames->stepS, *flown, (*planet)->tree().shape.radiusM));
}

}  // namespace worldy
