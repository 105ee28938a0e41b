#include "app/cli/cracks_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <tuple>
#include <vector>

#include "app/base/interrupt.h"
#include "app/base/message.h"
#include "app/base/picture_file.h"
#include "app/base/report.h"
#include "app/flight/flight_path.h"
#include "app/flight/flight_path_file.h"
#include "app/measure/cracks.h"
#include "app/scene/frame_report.h"
#include "app/scene/offscreen.h"
#include "planet/planet_tools.h"

namespace worldy {

namespace {

using Json = nlohmann::ordered_json;
using planet::Result;

// A cluster of crack pixels, and the chunks between which it lies if they are known.
struct ReportedSpot {
    planet::CrackSpot spot;
    std::optional<planet::ChunkId> finer;
    std::optional<planet::ChunkId> coarser;
};

struct MeasuredView {
    double timeS = 0;  // time in the flight
    SettledView at;
    std::size_t seams = 0;              // edges between different levels
    std::vector<planet::EdgeGap> gaps;  // gaps over 0, worst first
    std::size_t cracks = 0;
    int leaking = 0;
    std::vector<ReportedSpot> spots;  // largest first
    double requiredDepthM = 0;        // computed from the gaps
    double requiredFactor = 0;

    planet::EdgeGap worst() const { return gaps.empty() ? planet::EdgeGap{} : gaps.front(); }
};

struct Measured {
    std::vector<MeasuredView> views;
    SmallestSkirts smallest;  // if requested
    Picture marked;           // if requested
};

// Returns null for infinity, which JSON cannot represent.
Json numberOrNull(double value) {
    return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json jsonOf(const planet::EdgeGap& gap) {
    return {{"finer", planet::toString(gap.finer)},
            {"coarser", planet::toString(gap.coarser)},
            {"gap_m", gap.gapM},
            {"radial_m", gap.radialM},
            {"screen_px", gap.screenPx},
            {"facing_px", gap.facingPx},
            {"finer_above_m", gap.finerAboveM},
            {"coarser_above_m", gap.coarserAboveM},
            {"finer_skirt_m", gap.finerSkirtM},
            {"coarser_skirt_m", gap.coarserSkirtM}};
}

Json jsonOf(const ReportedSpot& reported) {
    const planet::CrackSpot& spot = reported.spot;
    Json entry = {{"pixels", spot.pixels},
                  {"leaking", spot.leaking},
                  {"from_px", {spot.from.x, spot.from.y}},
                  {"to_px", {spot.to.x, spot.to.y}},
                  {"centre_px", {spot.centre.x, spot.centre.y}}};
    if (reported.finer) entry["finer"] = planet::toString(*reported.finer);
    if (reported.coarser) entry["coarser"] = planet::toString(*reported.coarser);
    return entry;
}

std::vector<ReportedSpot> reportedSpots(const CrackMeasurement& measured) {
    std::vector<ReportedSpot> reported;
    for (const planet::CrackSpot& spot : measured.spots) {
        ReportedSpot one{spot, std::nullopt, std::nullopt};
        if (spot.pair != planet::noPair) {
            one.finer = measured.items[measured.pairs[spot.pair].finer];
            one.coarser = measured.items[measured.pairs[spot.pair].coarser];
        }
        reported.push_back(one);
    }
    return reported;
}

// Keeps the picture with marks if it is the worst so far.
Result<void> keepPicture(Offscreen& offscreen, const MeasuredView& view, const CrackMeasurement& measured,
                         const CracksOptions& options, Measured& all) {
    const auto badness = [](const MeasuredView& v) { return std::make_tuple(v.leaking, v.cracks); };
    const bool worse = std::all_of(all.views.begin(), all.views.end(),
                                   [&](const MeasuredView& other) { return badness(view) > badness(other); });
    if (!worse) return {};
    if (Result<void> drawn = drawAndFinish(offscreen, view.at.view, options.view); !drawn) return drawn;
    all.marked = readPicture(offscreen);
    markCracks(measured.map, all.marked);
    return {};
}

Result<void> measureView(Offscreen& offscreen, const planet::CameraPose& pose, double timeS,
                         const CracksOptions& options, Measured& all) {
    MeasuredView view;
    view.timeS = timeS;
    // Neither hysteresis nor resident chunks may carry over from the previous view.
    offscreen.scene.planet->tools().reset();
    view.at = settleAt(offscreen, pose, options.view);
    const Result<CrackMeasurement> measured = measureCracks(offscreen.scene, view.at.view, options.view);
    if (!measured) return tl::unexpected(measured.error());
    view.seams = measured->levelPairs;
    view.gaps = measured->gaps;
    view.cracks = measured->map.pixels.size();
    view.leaking = measured->map.leaking;
    view.spots = reportedSpots(*measured);
    view.requiredDepthM = measured->required.depthM;
    view.requiredFactor = measured->required.factor;
    if (options.findDepth) {
        const Result<SmallestSkirts> smallest =
            smallestSkirts(offscreen.scene, view.at.view, *measured, all.smallest);
        if (!smallest) return tl::unexpected(smallest.error());
        all.smallest = *smallest;
    }
    if (!options.markedPicture.empty()) {
        if (Result<void> kept = keepPicture(offscreen, view, *measured, options, all); !kept) return kept;
    }
    all.views.push_back(std::move(view));
    return {};
}

// Measures the views again with the found skirts. Returns the number of uncovered pixels with one depth, or
// with the factor.
Result<int> leaksWith(Offscreen& offscreen, const CracksOptions& options, const Measured& all,
                      planet::SkirtDepth kind) {
    ViewSettings settings = options.view;
    settings.lod.seams = planet::SeamMode::Skirts;
    settings.lod.skirtDepth = kind;
    settings.lod.skirtDepthM = all.smallest.depthM;
    settings.lod.skirtFactor = all.smallest.factor;
    int leaking = 0;
    for (const MeasuredView& view : all.views) {
        offscreen.scene.planet->tools().reset();
        const SettledView at = settleAt(offscreen, view.at.pose, settings);
        const Result<CrackMeasurement> measured = measureCracks(offscreen.scene, at.view, settings);
        if (!measured) return tl::unexpected(measured.error());
        leaking += measured->map.leaking;
    }
    return leaking;
}

struct Totals {
    std::size_t cracks = 0;
    std::size_t leaking = 0;
    std::size_t spots = 0;
    double worstGapM = 0;
    double worstGapPx = 0;
    double requiredDepthM = 0;
    double requiredFactor = 0;
};

Totals totalsOf(const std::vector<MeasuredView>& views) {
    Totals totals;
    for (const MeasuredView& view : views) {
        totals.cracks += view.cracks;
        totals.leaking += static_cast<std::size_t>(view.leaking);
        totals.spots += view.spots.size();
        totals.worstGapM = std::max(totals.worstGapM, view.worst().gapM);
        totals.worstGapPx = std::max(totals.worstGapPx, view.worst().facingPx);
        totals.requiredDepthM = std::max(totals.requiredDepthM, view.requiredDepthM);
        totals.requiredFactor = std::max(totals.requiredFactor, view.requiredFactor);
    }
    return totals;
}

// The uncovered pixels that remain when the same views are measured with the smallest skirts.
struct Proof {
    int leaksByDepth = 0;                // uncovered pixels
    std::optional<int> leaksByFactor{};  // none if no factor suffices
    bool tight() const { return leaksByDepth == 0 && leaksByFactor.value_or(0) == 0; }
};

constexpr std::array<const char*, 3> seamNames = {"none", "skirts", "stitched"};

Json reportOf(const CracksOptions& options, const Measured& all, const std::optional<Proof>& proof) {
    const Totals totals = totalsOf(all.views);
    Json report = {{"file", options.file.string()},
                   {"width_px", options.size.widthPx},
                   {"height_px", options.size.heightPx},
                   {"tau_px", options.view.lod.tauPx},
                   {"morph", options.view.lod.morph},
                   {"seams", seamNames[static_cast<std::size_t>(options.view.lod.seams)]},
                   {"views", all.views.size()},
                   {"crack_px", totals.cracks},
                   {"leaking_px", totals.leaking},
                   {"spots", totals.spots},
                   {"worst_gap_m", totals.worstGapM},
                   {"worst_gap_px", totals.worstGapPx},
                   {"cracks_by_rounding", *roundingNote(totals.cracks, totals.worstGapM) != '\0'},
                   {"depth_by_gaps_m", totals.requiredDepthM},
                   {"factor_by_gaps", numberOrNull(totals.requiredFactor)}};
    if (options.findDepth) {
        report["smallest_depth_m"] = all.smallest.depthM;
        report["smallest_factor"] = numberOrNull(all.smallest.factor);
        if (proof) report["leaking_px_at_smallest_depth"] = proof->leaksByDepth;
        if (proof && proof->leaksByFactor) report["leaking_px_at_smallest_factor"] = *proof->leaksByFactor;
    }
    report["view"] = Json::array();
    for (const MeasuredView& view : all.views) {
        Json entry = {{"time_s", view.timeS},
                      {"camera", poseJson(view.at.pose)},
                      {"lifted", view.at.lifted},
                      {"settled", view.at.settled},
                      {"seams", view.seams},
                      {"worst_gap_m", view.worst().gapM},
                      {"worst_gap_px", view.worst().facingPx},
                      {"crack_px", view.cracks},
                      {"leaking_px", view.leaking}};
        entry["gaps"] = Json::array();
        for (const planet::EdgeGap& gap : view.gaps) entry["gaps"].push_back(jsonOf(gap));
        entry["spots"] = Json::array();
        for (const ReportedSpot& spot : view.spots) entry["spots"].push_back(jsonOf(spot));
        report["view"].push_back(std::move(entry));
    }
    return report;
}

void printTable(const Measured& all) {
    fmt::print("{:>8}{:>8}{:>14}{:>14}{:>12}{:>14}{:>10}\n", "time, s", "seams", "max gap, m", "max gap, px",
               "crack px", "uncovered px", "clusters");
    for (const MeasuredView& view : all.views) {
        fmt::print("{:8.1f}{:8}{:14.3f}{:14.3f}{:12}{:14}{:10}{}\n", view.timeS, view.seams,
                   view.worst().gapM, view.worst().facingPx, view.cracks, view.leaking, view.spots.size(),
                   view.at.settled ? "" : "  chunks missing");
    }
    const Totals totals = totalsOf(all.views);
    fmt::print("{:>16}{:14.3f}{:14.3f}{:12}{:14}{:10}\n", "all views", totals.worstGapM, totals.worstGapPx,
               totals.cracks, totals.leaking, totals.spots);
    const std::string note = roundingNote(totals.cracks, totals.worstGapM);
    if (!note.empty()) fmt::print("{}\n", note);
}

// Prints the largest clusters and the widest gaps of all views.
void printWorst(const std::vector<MeasuredView>& views, int worst) {
    struct Spot {
        double timeS;
        const ReportedSpot* reported;
    };
    struct Gap {
        double timeS;
        const planet::EdgeGap* gap;
    };
    std::vector<Spot> spots;
    std::vector<Gap> gaps;
    for (const MeasuredView& view : views) {
        for (const ReportedSpot& spot : view.spots) spots.push_back({view.timeS, &spot});
        for (const planet::EdgeGap& gap : view.gaps) gaps.push_back({view.timeS, &gap});
    }
    std::stable_sort(spots.begin(), spots.end(), [](const Spot& a, const Spot& b) {
        return a.reported->spot.pixels > b.reported->spot.pixels;
    });
    std::stable_sort(gaps.begin(), gaps.end(),
                     [](const Gap& a, const Gap& b) { return a.gap->gapM > b.gap->gapM; });
    const auto listed = static_cast<std::size_t>(worst);
    spots.resize(std::min(spots.size(), listed));
    gaps.resize(std::min(gaps.size(), listed));
    if (!spots.empty()) {
        fmt::print("\nlargest crack clusters\n{:>8}{:>10}{:>14}{:>8}{:>8}  {:22}{}\n", "time, s", "crack px",
                   "uncovered px", "x", "y", "finer", "coarser");
    }
    const auto nameOf = [](const std::optional<planet::ChunkId>& id) {
        return id ? planet::toString(*id) : std::string("-");
    };
    for (const Spot& one : spots) {
        const planet::CrackSpot& spot = one.reported->spot;
        fmt::print("{:8.1f}{:10}{:14}{:8.0f}{:8.0f}  {:22}{}\n", one.timeS, spot.pixels, spot.leaking,
                   spot.centre.x, spot.centre.y, nameOf(one.reported->finer), nameOf(one.reported->coarser));
    }
    if (!gaps.empty())
        fmt::print("\nwidest gaps\n{:>8}{:>14}{:>14}  {:22}{}\n", "time, s", "gap, m", "gap, px", "finer",
                   "coarser");
    for (const Gap& one : gaps) {
        fmt::print("{:8.1f}{:14.3f}{:14.3f}  {:22}{}\n", one.timeS, one.gap->gapM, one.gap->facingPx,
                   planet::toString(one.gap->finer), planet::toString(one.gap->coarser));
    }
}

Result<Proof> prove(Offscreen& offscreen, const CracksOptions& options, const Measured& all) {
    const Result<int> byDepth = leaksWith(offscreen, options, all, planet::SkirtDepth::Fixed);
    if (!byDepth) return tl::unexpected(byDepth.error());
    if (!std::isfinite(all.smallest.factor)) return Proof{*byDepth};
    return leaksWith(offscreen, options, all, planet::SkirtDepth::Automatic).map([&](int byFactor) {
        return Proof{*byDepth, byFactor};
    });
}

void print(const Proof& proof, const Measured& all) {
    const Totals totals = totalsOf(all.views);
    fmt::print("\nsmallest depth: {:.2f} m (required by max gap: {:.2f} m); verified: {} uncovered px\n",
               all.smallest.depthM, totals.requiredDepthM, proof.leaksByDepth);
    if (!proof.leaksByFactor) {
        fmt::print("no automatic factor up to 1000 is enough\n");
        return;
    }
    fmt::print("smallest factor: {:.3f} (required by max gap: {:.3f}); verified: {} uncovered px\n",
               all.smallest.factor, totals.requiredFactor, *proof.leaksByFactor);
}

Result<void> measureAll(Offscreen& offscreen, const CracksOptions& options, Measured& all) {
    if (options.flight.empty()) {
        const double radiusM = offscreen.scene.planet->tree().shape.radiusM;
        return measureView(offscreen, options.camera.value_or(startPose(options.start, radiusM)), 0, options,
                           all);
    }
    const Result<FlightPath> path = loadFlightPath(options.flight);
    if (!path) return tl::unexpected(path.error());
    const InterruptWatch watch;
    const Result<FlightFrames> frames = framesOf(*path, options.sampling, mostFlightViews);
    if (!frames) return tl::unexpected(frames.error());
    for (int i = 0; i < frames->count; ++i) {
        if (watch.interrupted()) return planet::cancelled();
        const double timeS = frames->timeS(i);
        if (Result<void> done = measureView(offscreen, poseAt(*path, timeS), timeS, options, all); !done)
            return done;
    }
    return {};
}

}  // namespace

Result<bool> runCracks(const CracksOptions& options) {
    if (options.findDepth && options.view.lod.seams == planet::SeamMode::Stitched) {
        return planet::badInput("--find-depth: stitched seams have no skirts; expected --seams skirts");
    }
    const SceneConfig config{.chunkFile = options.file, .shaderFolder = options.shaderFolder};
    Result<Offscreen> offscreen = openOffscreen(config, options.view, options.size, 1);
    if (!offscreen) return tl::unexpected(offscreen.error());
    Measured all;
    if (const Result<void> done = measureAll(*offscreen, options, all); !done)
        return tl::unexpected(done.error());
    for (const std::string& problem : takeProblems(offscreen->scene)) printMessage("worldy: {}\n", problem);
    if (!options.report.json) {
        printTable(all);
        printWorst(all.views, options.worst);
    }
    bool tight = totalsOf(all.views).leaking == 0;
    std::optional<Proof> proof;
    if (options.findDepth) {
        const Result<Proof> proven = prove(*offscreen, options, all);
        if (!proven) return tl::unexpected(proven.error());
        proof = *proven;
        if (!options.report.json) print(*proof, all);
        tight = tight && proof->tight();
    }
    if (!options.markedPicture.empty()) {
        if (const Result<void> written = writePicture(all.marked, options.markedPicture); !written)
            return tl::unexpected(written.error());
    }
    return writeReport(options.report, reportOf(options, all, proof)).map([&] { return tight; });
}

}  // namespace worldy
