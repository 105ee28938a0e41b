#include "app/cli/audit_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <numeric>
#include <tuple>

#include "app/base/glossary.h"
#include "app/base/interrupt.h"
#include "app/base/message.h"
#include "app/base/report.h"
#include "app/base/stopwatch.h"
#include "app/base/text.h"
#include "app/flight/flight_path.h"
#include "app/flight/flight_path_file.h"
#include "app/measure/audit_views.h"
#include "app/scene/camera_control.h"
#include "app/scene/frame_report.h"
#include "app/scene/scene.h"
#include "app/scene/scene_settings.h"
#include "planet/base/percentile.h"
#include "planet/planet.h"
#include "planet/planet_tools.h"

namespace worldy {

namespace {

using Json = nlohmann::ordered_json;
using planet::ChunkError;
using planet::Planet;
using planet::Result;
using planet::TrueErrorReport;

Result<std::vector<planet::CameraPose>> flightPoses(const AuditOptions& options) {
    const Result<FlightPath> path = loadFlightPath(options.flight);
    if (!path) return tl::unexpected(path.error());
    const Result<FlightFrames> frames = framesOf(*path, options.sampling, mostFlightViews);
    if (!frames) return tl::unexpected(frames.error());
    std::vector<planet::CameraPose> poses;
    for (int i = 0; i < frames->count; ++i) poses.push_back(poseAt(*path, frames->timeS(i)));
    return poses;
}

Result<std::vector<planet::CameraPose>> posesOf(const AuditOptions& options, const Planet& planet) {
    if (!options.flight.empty()) return flightPoses(options);
    if (!options.cameras.empty()) return options.cameras;
    return auditPoses(planet.file());
}

// Settles a view without blocks from earlier views, since a full budget and the height of the ground depend
// on what is resident. A camera below the ground is lifted above it once the view has settled.
AuditedView settleAt(Planet& planet, const planet::CameraPose& pose, const planet::LodSettings& lod,
                     const AuditOptions& options, planet::View& view) {
    const double radiusM = planet.tree().shape.radiusM;
    Camera camera = cameraFromPose(pose, radiusM);
    AuditedView audited;
    planet.tools().reset();
    for (int attempt = 0; attempt < 4; ++attempt) {
        view = viewOf(camera, glm::radians(options.view.camera.fovDeg), options.size.widthPx,
                      options.size.heightPx);
        planet.tools().forgetSelections();
        audited.settled = planet.settle(view, lod, planet::noUpload, settleTimeoutS);
        const Ground ground{radiusM, planet::residentHeightM(planet.tree(), glm::normalize(camera.eyeM))};
        if (altitudeM(camera, ground) >= ground.heightM + minGroundClearanceM - 1e-3) break;
        camera = keepInRange(camera, ground);
    }
    audited.pose = planet::poseFromView(view, radiusM);
    audited.groundTriangles = planet.selection().counters.groundTriangles;
    audited.skirtTriangles = planet.selection().counters.skirtTriangles;
    return audited;
}

// A chunk in one of the views.
struct Listed {
    std::size_t view = 0;
    const ChunkError* chunk = nullptr;
};

std::vector<Listed> worstChunks(const Audit& audit, int count) {
    std::vector<Listed> all;
    for (std::size_t view = 0; view < audit.views.size(); ++view) {
        for (const ChunkError& chunk : audit.views[view].report.chunks) all.push_back({view, &chunk});
    }
    const auto kept = static_cast<std::ptrdiff_t>(std::min(all.size(), static_cast<std::size_t>(count)));
    std::partial_sort(all.begin(), all.begin() + kept, all.end(), [](const Listed& a, const Listed& b) {
        const auto key = [](const Listed& one) {
            return std::tuple(!planet::isViolation(*one.chunk), -one.chunk->facingPx, one.view,
                              one.chunk->id);
        };
        return key(a) < key(b);
    });
    all.resize(static_cast<std::size_t>(kept));
    return all;
}

struct Place {
    double latitudeDeg = 0;
    double longitudeDeg = 0;
};

Place groundPlaceOf(const glm::dvec3& pointM) {
    const planet::Geographic place = planet::geographicFromDirection(pointM);
    return {glm::degrees(place.latitudeRad), glm::degrees(place.longitudeRad)};
}

Json jsonOf(const ChunkError& chunk) {
    Json json = {{"chunk", planet::toString(chunk.id)},
                 {terms::epsPx.key, chunk.epsPx},
                 {terms::drawnBoundPx.key, chunk.drawnBoundPx},
                 {terms::measuredPx.key, chunk.facingPx},
                 {terms::screenPx.key, chunk.screenPx},
                 {"error_m", chunk.errorM},
                 {"mean_px", chunk.meanPx},
                 {"samples", chunk.samples},
                 {"violation", planet::isViolation(chunk)}};
    if (chunk.facingPx > 0) {
        const Place worst = groundPlaceOf(chunk.worstM);
        json["worst_latitude_deg"] = worst.latitudeDeg;
        json["worst_longitude_deg"] = worst.longitudeDeg;
        json["worst_beside_stitched_edge"] = chunk.worstInSeam;
    }
    return json;
}

// Adds the figures of one view, or of all together.
void addFigures(const TrueErrorReport& report, Json& json) {
    json["worst_eps_px"] = report.worstEpsPx;
    json["worst_drawn_bound_px"] = report.worstDrawnBoundPx;
    json["worst_measured_px"] = report.worstFacingPx;
    json["worst_screen_px"] = report.worstScreenPx;
    json["p99_measured_px"] = report.p99FacingPx;
    json["p99_screen_px"] = report.p99ScreenPx;
    json["mean_slack"] = report.meanSlack;
    json["violations"] = report.violations;
    json["violations_beside_stitched_edges"] = report.violationsInSeams;
    json["samples"] = report.samples;
}

Json jsonOf(const AuditedView& view) {
    const TrueErrorReport& report = view.report;
    Json json = {{"camera", poseJson(view.pose)},
                 {"settled", view.settled},
                 {terms::drawnChunks.key, report.chunks.size()},
                 {terms::groundTriangles.key, view.groundTriangles},
                 {terms::skirtTriangles.key, view.skirtTriangles},
                 {terms::triangles.key, view.groundTriangles + view.skirtTriangles}};
    addFigures(report, json);
    json["chunk"] = Json::array();
    for (const ChunkError& chunk : report.chunks) json["chunk"].push_back(jsonOf(chunk));
    return json;
}

std::uint64_t samplesOf(const Audit& audit) {
    return std::accumulate(
        audit.views.begin(), audit.views.end(), std::uint64_t{0},
        [](std::uint64_t sum, const AuditedView& view) { return sum + view.report.samples; });
}

// Returns the totals over all views: sums, and maxima of the worst figures.
TrueErrorReport totalsOf(const Audit& audit) {
    TrueErrorReport totals;
    std::vector<double> facing;
    std::vector<double> screen;
    double slack = 0;
    for (const AuditedView& view : audit.views) {
        const TrueErrorReport& report = view.report;
        totals.worstEpsPx = std::max(totals.worstEpsPx, report.worstEpsPx);
        totals.worstDrawnBoundPx = std::max(totals.worstDrawnBoundPx, report.worstDrawnBoundPx);
        totals.worstFacingPx = std::max(totals.worstFacingPx, report.worstFacingPx);
        totals.worstScreenPx = std::max(totals.worstScreenPx, report.worstScreenPx);
        totals.violations += report.violations;
        totals.violationsInSeams += report.violationsInSeams;
        totals.samples += report.samples;
        slack += report.meanSlack;
        for (const ChunkError& chunk : report.chunks) {
            facing.push_back(chunk.facingPx);
            screen.push_back(chunk.screenPx);
        }
    }
    totals.p99FacingPx = planet::percentileOf(facing, 0.99);
    totals.p99ScreenPx = planet::percentileOf(screen, 0.99);
    totals.meanSlack = audit.views.empty() ? 0 : slack / static_cast<double>(audit.views.size());
    return totals;
}

// There is no useful bound if the eye is inside the bounds of a chunk with an error.
std::string columnText(double px) {
    return px < 1e5 ? fmt::format("{:.3f}", px) : fmt::format("{:.1e}", px);
}

void printRow(const std::string& name, std::size_t chunks, std::uint64_t triangles,
              const TrueErrorReport& report) {
    fmt::print("{:>5}{:>8}{:>11}{:>11}{:>11}{:>11}{:>11}{:>11}{:>8.1f}{:>12}\n", name, chunks,
               countText(static_cast<double>(triangles)), columnText(report.worstEpsPx),
               columnText(report.worstDrawnBoundPx), columnText(report.worstFacingPx),
               columnText(report.p99FacingPx), columnText(report.worstScreenPx), 100 * report.meanSlack,
               report.violations);
}

void printWorst(const Audit& audit, int count) {
    const std::vector<Listed> worst = worstChunks(audit, count);
    if (worst.empty() || worst.front().chunk->facingPx <= 0) return;
    fmt::print("\n{:>5}  {:24}{:>11}{:>11}{:>11}{:>12}  {}\n", "view", "chunks by error", "bound", "measured",
               "screen", "error", "at");
    for (const Listed& one : worst) {
        const ChunkError& chunk = *one.chunk;
        if (chunk.facingPx <= 0) break;
        const Place place = groundPlaceOf(chunk.worstM);
        fmt::print("{:>5}  {:24}{:>11}{:>11}{:>11}{:>10.2f} m  {}{}\n", one.view + 1,
                   planet::toString(chunk.id), columnText(chunk.drawnBoundPx), columnText(chunk.facingPx),
                   columnText(chunk.screenPx), chunk.errorM, placeText(place.latitudeDeg, place.longitudeDeg),
                   planet::isViolation(chunk) ? "  VIOLATION" : "");
    }
}

}  // namespace

std::uint32_t Audit::violations() const {
    return totalsOf(*this).violations;
}

Result<Audit> audit(const AuditOptions& options) {
    Result<std::unique_ptr<Planet>> opened = Planet::open(options.file, pagingSettingsOf(options.view));
    if (!opened) return tl::unexpected(opened.error());
    Planet& planet = **opened;
    planet.setExaggeration(options.view.surface.exaggeration);
    if (const Result<void> set = planet.setRegions(options.view.regions.applied()); !set)
        return tl::unexpected(set.error());
    const auto poses = posesOf(options, planet);
    if (!poses) return tl::unexpected(poses.error());

    const planet::LodSettings lod = lodSettingsOf(options.view);
    planet::FinestHeights heights(std::make_shared<const planet::ChunkFile>(planet.file()));
    const InterruptWatch watch;
    const auto goOn = [&](std::uint64_t, std::uint64_t) { return !watch.interrupted(); };
    Audit audit;
    for (const planet::CameraPose& pose : *poses) {
        planet::View view;
        AuditedView audited = settleAt(planet, pose, lod, options, view);
        if (watch.interrupted()) return planet::cancelled();
        const planet::DrawnSnapshot snapshot = planet::snapshotOf(
            planet.tree(), planet.selection().draw, view, lod.seams == planet::SeamMode::Stitched);
        const Stopwatch measuring;
        Result<TrueErrorReport> report = planet::measureTrueError(snapshot, heights, goOn);
        if (!report) return tl::unexpected(report.error());
        audit.measuringS += measuring.elapsedMs() / 1000;
        audited.report = std::move(*report);
        audit.views.push_back(std::move(audited));
    }
    audit.blocksRead = heights.blocksRead();
    for (const std::string& problem : planet.takeProblems()) printMessage("worldy: {}\n", problem);
    return audit;
}

void printAudit(const AuditOptions& options, const Audit& audit) {
    fmt::print("{}: tau {} px, {} metric, {} x {} px\n", options.file.string(), options.view.lod.tauPx,
               options.view.lod.metric == planet::ErrorMetric::Tight ? "tight" : "additive",
               options.size.widthPx, options.size.heightPx);
    fmt::print(
        "eps: predicted error of the chunk's own surface; bound: bound of the error of what is drawn, "
        "including "
        "morph;\nmeasured: true error, facing the sample; screen: screen-space error; all in pixels, the "
        "largest of any chunk.\np99: 99th percentile of the chunks' measured error. slack: in % of the "
        "bound.\n\n");
    fmt::print("{:>5}{:>8}{:>11}{:>11}{:>11}{:>11}{:>11}{:>11}{:>8}{:>12}\n", "view", "chunks", "triangles",
               "eps", "bound", "measured", "p99", "screen", "slack", "violations");
    std::size_t chunks = 0;
    std::uint64_t triangles = 0;
    for (std::size_t i = 0; i < audit.views.size(); ++i) {
        const AuditedView& view = audit.views[i];
        chunks += view.report.chunks.size();
        const std::uint64_t ofView = view.groundTriangles + view.skirtTriangles;
        triangles += ofView;
        printRow(fmt::format("{}", i + 1), view.report.chunks.size(), ofView, view.report);
        if (!view.settled) printMessage("worldy: view {}: loading timed out; chunks are missing\n", i + 1);
    }
    printRow("all", chunks, triangles, totalsOf(audit));
    printWorst(audit, options.worst);
    const auto samples = static_cast<double>(samplesOf(audit));
    fmt::print(
        "\n{} samples compared in {}, {:.1f} ns each; {} blocks read beyond those that were resident\n",
        countText(samples), durationText(audit.measuringS), 1e9 * audit.measuringS / std::max(samples, 1.0),
        audit.blocksRead);
}

Json auditJson(const AuditOptions& options, const Audit& audit) {
    Json json = {{"file", options.file.string()},
                 {"tau_px", options.view.lod.tauPx},
                 {"metric", options.view.lod.metric == planet::ErrorMetric::Tight ? "tight" : "additive"},
                 {"width_px", options.size.widthPx},
                 {"height_px", options.size.heightPx},
                 {"measuring_s", audit.measuringS},
                 {"blocks_read", audit.blocksRead}};
    addFigures(totalsOf(audit), json);
    json["view"] = Json::array();
    for (const AuditedView& view : audit.views) json["view"].push_back(jsonOf(view));
    return json;
}

Result<bool> runAudit(const AuditOptions& options) {
    const Result<Audit> audited = audit(options);
    if (!audited) return tl::unexpected(audited.error());
    if (!options.report.json) printAudit(options, *audited);
    return writeReport(options.report, auditJson(options, *audited)).map([&] {
        return audited->violations() == 0;
    });
}

}  // namespace worldy
