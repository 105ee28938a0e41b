#include "app/pops_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <glm/trigonometric.hpp>
#include <nlohmann/json.hpp>
#include <thread>
#include <vector>

#include "app/camera_control.h"
#include "app/flight_path.h"
#include "app/interrupt.h"
#include "app/output_file.h"
#include "app/report.h"
#include "app/scene.h"
#include "app/stopwatch.h"
#include "planet/percentile.h"
#include "planet/pop_meter.h"

namespace worldy {

namespace {

using Json = nlohmann::ordered_json;
using planet::percentileOf;
using planet::PopEvent;
using planet::Result;

constexpr double settleTimeoutS = 120;
constexpr std::size_t worstTold = 20;
constexpr std::array shares = {0.5, 0.9, 0.99, 1.0};
constexpr std::array<const char*, shares.size()> shareNames = {"p50", "p90", "p99", "maximum"};

void noUpload(std::uint32_t, std::span<const std::int16_t>) {}

planet::View viewAt(const planet::Planet& planet, const FlightPath& path, double timeS,
                    const PopsOptions& options) {
    const double radiusM = planet.shape().radiusM;
    const Camera wanted = cameraFromPose(poseAt(path, timeS), radiusM);
    const Ground ground{radiusM, planet::residentHeightM(planet.tree(), wanted.eyeM)};
    return viewOf(keepInRange(wanted, ground), glm::radians(options.view.camera.fovDeg), options.size.widthPx,
                  options.size.heightPx);
}

// One frame of so many seconds, in which all that it wants arrives.
Result<void> stepOnTime(planet::Planet& planet, const planet::ViewInput& view, double elapsedS,
                        const InterruptWatch& watch) {
    const Stopwatch waited;
    planet.step({&view, 1}, noUpload, elapsedS);
    while (!planet.settled()) {
        if (watch.interrupted()) return planet::cancelled();
        if (waited.elapsedMs() > 1000 * settleTimeoutS)
            return planet::ioError(
                fmt::format("what a view wants was not loaded within {:.0f} s", settleTimeoutS));
        std::this_thread::sleep_for(std::chrono::microseconds(100));
        planet.step({&view, 1}, noUpload, 0);
    }
    return {};
}

struct Flown {
    std::vector<PopEvent> events;
    planet::PopTotals totals;
    double usPerSwitch = 0;
    int frames = 0;
};

Result<Flown> fly(planet::Planet& planet, const FlightPath& path, const PopsOptions& options) {
    const InterruptWatch watch;
    const planet::LodSettings lod = lodSettingsOf(options.view);
    const double startS = path.keys.front().timeS;
    Flown flown;
    flown.frames = static_cast<int>(std::floor(durationS(path) / options.stepS)) + 1;
    planet::PopMeter meter;
    for (int i = 0; i < flown.frames; ++i) {
        const double timeS = startS + i * options.stepS;
        const planet::View view = viewAt(planet, path, timeS, options);
        const Result<void> stepped = stepOnTime(planet, {view, lod, 1}, i == 0 ? 0 : options.stepS, watch);
        if (!stepped) return tl::unexpected(stepped.error());
        meter.add(planet.tree(), planet.selection(), view, lod, i * options.stepS);
        // It forgets what is minutes old.
        const auto& events = meter.events();
        for (auto event = events.rbegin();
             event != events.rend() && event->frame == static_cast<std::uint64_t>(i); ++event)
            flown.events.push_back(*event);
    }
    flown.totals = meter.totals();
    flown.usPerSwitch = meter.measuredUsPerSwitch();
    return flown;
}

// Of the switches in the picture.
std::vector<double> jumpsOf(const Flown& flown) {
    std::vector<double> jumps;
    for (const PopEvent& event : flown.events) {
        if (event.jump.places > 0) jumps.push_back(event.jump.largestPx);
    }
    return jumps;
}

std::vector<const PopEvent*> worstOf(const Flown& flown) {
    std::vector<const PopEvent*> worst;
    for (const PopEvent& event : flown.events) worst.push_back(&event);
    const auto count = std::min(worst.size(), worstTold);
    std::partial_sort(worst.begin(), worst.begin() + static_cast<std::ptrdiff_t>(count), worst.end(),
                      [](const PopEvent* a, const PopEvent* b) {
                          if (a->jump.largestPx != b->jump.largestPx)
                              return a->jump.largestPx > b->jump.largestPx;
                          return a->frame != b->frame ? a->frame < b->frame : a->chunk < b->chunk;
                      });
    worst.resize(count);
    return worst;
}

Json jsonOf(const PopEvent& event, double radiusM) {
    return {{"time_s", event.timeS},
            {"chunk", planet::toString(event.chunk)},
            {"from_level", event.fromLevel},
            {"to_level", event.toLevel},
            {"cause", planet::popCauseName(event.cause)},
            {"largest_px", event.jump.largestPx},
            {"largest_facing_px", event.jump.largestFacingPx},
            {"mean_px", event.jump.meanPx},
            {"beside_px", event.besidePx},
            {"camera", worldy::jsonOf(planet::poseFromView(event.view, radiusM))}};
}

Json jsonOf(const PopsOptions& options, const FlightPath& path, const Flown& flown, double radiusM) {
    Json report = {{"flight", path.name},
                   {"file", options.file.string()},
                   {"frames", flown.frames},
                   {"step_s", options.stepS},
                   {"width_px", options.size.widthPx},
                   {"height_px", options.size.heightPx},
                   {"tau_px", options.view.lod.tauPx},
                   {"morph", options.view.lod.morph},
                   {"switches", flown.totals.switches},
                   {"outside_picture", flown.totals.outsidePicture},
                   {"late", flown.totals.late},
                   {"worst_beside_px", flown.totals.worstBesidePx},
                   {"measuring_us_per_switch", flown.usPerSwitch}};
    std::vector<double> jumps = jumpsOf(flown);
    for (std::size_t i = 0; i < shares.size(); ++i)
        report["largest_px"][shareNames[i]] = percentileOf(jumps, shares[i]);
    for (std::size_t i = 0; i < planet::popCauseCount; ++i)
        report["cause"][planet::popCauseName(static_cast<planet::PopCause>(i))] = flown.totals.byCause[i];
    report["worst"] = Json::array();
    for (const PopEvent* event : worstOf(flown)) report["worst"].push_back(jsonOf(*event, radiusM));
    return report;
}

void printSummary(const FlightPath& path, const PopsOptions& options, const Flown& flown) {
    std::vector<double> jumps = jumpsOf(flown);
    fmt::print("{}: {} frames, {:.4g} s apart\n", path.name, flown.frames, options.stepS);
    fmt::print("{} switches of level, {} of them outside the picture; {:.0f} us to measure one\n",
               flown.totals.switches, flown.totals.outsidePicture, flown.usPerSwitch);
    for (std::size_t i = 0; i < planet::popCauseCount; ++i) {
        if (flown.totals.byCause[i] == 0) continue;
        fmt::print("  {:18}{:8}\n", planet::popCauseName(static_cast<planet::PopCause>(i)),
                   flown.totals.byCause[i]);
    }
    if (jumps.empty()) return;
    fmt::print(
        "99% of switches move less than {:.4f} px; median {:.4f}, 90% {:.4f}, worst {:.4f} px; edges "
        "beside them {:.4f} px\n\n",
        percentileOf(jumps, 0.99), percentileOf(jumps, 0.5), percentileOf(jumps, 0.9), percentileOf(jumps, 1),
        flown.totals.worstBesidePx);
    fmt::print("{:>10}  {:22}{:>8}{:>14}{:>14}{:>14}  {}\n", "time", "chunk", "levels", "largest px",
               "mean px", "beside px", "cause");
    for (const PopEvent* event : worstOf(flown)) {
        fmt::print("{:8.2f} s  {:22}{:>8}{:14.4f}{:14.4f}{:14.4f}  {}\n", event->timeS,
                   planet::toString(event->chunk), fmt::format("{} > {}", event->fromLevel, event->toLevel),
                   event->jump.largestPx, event->jump.meanPx, event->besidePx,
                   planet::popCauseName(event->cause));
    }
}

}  // namespace

Result<void> runPops(const PopsOptions& options) {
    const Result<FlightPath> path = loadFlightPath(options.flight);
    if (!path) return tl::unexpected(path.error());
    auto planet = planet::Planet::open(options.file, pagingSettingsOf(options.view));
    if (!planet) return tl::unexpected(planet.error());
    (*planet)->setExaggeration(options.view.surface.exaggeration);
    const Result<Flown> flown = fly(**planet, *path, options);
    if (!flown) return tl::unexpected(flown.error());
    for (const std::string& problem : (*planet)->takeProblems()) fmt::print(stderr, "worldy: {}\n", problem);
    printSummary(*path, options, *flown);
    if (options.output.empty()) return {};
    return writeTextFile(options.output,
                         jsonOf(options, *path, *flown, (*planet)->shape().radiusM).dump(1) + "\n");
}

}  // namespace worldy
