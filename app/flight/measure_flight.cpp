#include "app/flight/measure_flight.h"

#include <algorithm>
#include <numeric>
#include <vector>

#include "app/base/stopwatch.h"
#include "planet/base/percentile.h"
#include "planet/measure/true_error.h"
#include "planet/planet_tools.h"

namespace worldy {

namespace {

using planet::Result;

// The values of all frames, from which the figures are computed.
struct Gathered {
    std::vector<double> groundTriangles;
    std::vector<double> skirtTriangles;
    std::vector<double> triangles;  // ground and skirt triangles
    std::vector<double> chunks;
    std::vector<double> frameMs;
    std::vector<double> measuredPx;  // one per chunk and frame
};

double meanOf(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

Result<void> addError(const Offscreen& offscreen, const planet::View& view, const ViewSettings& settings,
                      planet::FinestHeights& heights, const std::function<bool()>& goOn, Gathered& gathered,
                      FlightFigures& figures) {
    const planet::Planet& planet = *offscreen.scene.planet;
    const Result<planet::TrueErrorReport> report =
        planet::measureTrueError(planet::snapshotOf(planet.tree(), planet.selection().draw, view,
                                                    settings.lod.seams == planet::SeamMode::Stitched),
                                 heights, [&](std::uint64_t, std::uint64_t) { return goOn(); });
    if (!report) return tl::unexpected(report.error());
    figures.worstEpsPx = std::max(figures.worstEpsPx, report->worstEpsPx);
    figures.worstDrawnBoundPx = std::max(figures.worstDrawnBoundPx, report->worstDrawnBoundPx);
    figures.worstMeasuredPx = std::max(figures.worstMeasuredPx, report->worstFacingPx);
    figures.worstScreenPx = std::max(figures.worstScreenPx, report->worstScreenPx);
    figures.violations += report->violations;
    for (const planet::ChunkError& chunk : report->chunks) gathered.measuredPx.push_back(chunk.facingPx);
    return {};
}

// Draws twice, because the first draw of a view uploads; only the second is timed.
Result<void> addCost(Offscreen& offscreen, const planet::View& view, const ViewSettings& settings,
                     Gathered& gathered, FlightFigures& figures) {
    if (Result<void> drawn = drawAndFinish(offscreen, view, settings); !drawn) return drawn;
    const Stopwatch watch;
    stepScene(offscreen.scene, view, settings);
    if (Result<void> drawn = drawAndFinish(offscreen, view, settings); !drawn) return drawn;
    gathered.frameMs.push_back(watch.elapsedMs());
    const FrameStats stats = statsOf(offscreen.scene);
    gathered.groundTriangles.push_back(static_cast<double>(stats.selection.groundTriangles));
    gathered.skirtTriangles.push_back(static_cast<double>(stats.selection.skirtTriangles));
    gathered.triangles.push_back(static_cast<double>(stats.selection.triangles()));
    gathered.chunks.push_back(stats.selection.drawn);
    const auto bytes = static_cast<double>(stats.paging.residentBytesCpu + stats.paging.residentBytesGpu);
    figures.mostResidentMiB = std::max(figures.mostResidentMiB, bytes / (1 << 20));
    return {};
}

}  // namespace

Result<FlightFigures> measureFlight(Offscreen& offscreen, const FlightPath& path,
                                    const ViewSettings& settings, const FlightFrames& frames,
                                    FigureSet wanted, planet::FinestHeights& heights, const KeepFlying& goOn,
                                    const AtMoment& atMoment) {
    FlightFigures figures;
    Gathered gathered;
    // Chunks left from other settings must not count as memory of these.
    offscreen.scene.planet->tools().dropAll();
    const std::uint64_t readBefore = offscreen.scene.planet->paging().bytesRead();
    for (int i = 0; i < frames.count; ++i) {
        const std::function<bool()> goOnHere = [&] { return goOn(i); };
        if (!goOnHere()) return planet::cancelled();
        const SettledView at = settleAt(offscreen, poseAt(path, frames.timeS(i)), settings, goOnHere);
        if (!at.settled && !goOnHere()) return planet::cancelled();
        if (!at.settled) return loadingTimedOut();
        if (const Result<void> added = addCost(offscreen, at.view, settings, gathered, figures); !added)
            return tl::unexpected(added.error());
        if (wanted == FigureSet::CostAndError) {
            const auto added = addError(offscreen, at.view, settings, heights, goOnHere, gathered, figures);
            if (!added) return tl::unexpected(added.error());
        }
        if (!atMoment) continue;
        if (const Result<void> looked = atMoment(offscreen, at); !looked)
            return tl::unexpected(looked.error());
    }
    figures.bytesRead = offscreen.scene.planet->paging().bytesRead() - readBefore;
    figures.frames = frames.count;
    figures.meanGroundTriangles = meanOf(gathered.groundTriangles);
    figures.meanSkirtTriangles = meanOf(gathered.skirtTriangles);
    figures.meanTriangles = meanOf(gathered.triangles);
    figures.mostTriangles = *std::max_element(gathered.triangles.begin(), gathered.triangles.end());
    figures.meanChunks = meanOf(gathered.chunks);
    figures.medianFrameMs = planet::percentileOf(gathered.frameMs, 0.5);
    figures.p99MeasuredPx = planet::percentileOf(gathered.measuredPx, 0.99);
    return figures;
}

}  // namespace worldy
