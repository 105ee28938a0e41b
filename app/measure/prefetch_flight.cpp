#include "app/measure/prefetch_flight.h"

#include <glm/trigonometric.hpp>
#include <optional>
#include <span>

#include "app/flight/announce_flight.h"
#include "app/scene/camera_control.h"
#include "app/scene/scene.h"
#include "app/scene/scene_settings.h"
#include "planet/planet_tools.h"

namespace worldy {

namespace {

using planet::Result;

// A planet that is flown over without being drawn.
struct PrefetchFlight {
    planet::Planet& planet;
    const FlightPath& path;
    const ViewSettings& settings;
    const PictureSize& size;

    planet::ViewInput viewAt(double timeS) const {
        const double radiusM = planet.tree().shape.radiusM;
        const Camera wanted = cameraFromPose(poseAt(path, timeS), radiusM);
        const Ground ground{radiusM, planet::residentHeightM(planet.tree(), wanted.eyeM)};
        return {viewOf(keepInRange(wanted, ground), glm::radians(settings.camera.fovDeg), size.widthPx,
                       size.heightPx),
                lodSettingsOf(settings), 1, colourSettingsOf(settings), normalSettingsOf(settings)};
    }

    void dropTileChanges() const {
        for (const planet::BlockKind kind : {planet::BlockKind::Colours, planet::BlockKind::Normals})
            planet.takeTileChanges(kind);
    }
};

Result<void> settleForPrefetch(const PrefetchFlight& flown, const KeepPrefetching& goOn) {
    constexpr int mostLifts = 5;  // loaded ground may lift the camera, which then needs more blocks
    for (int i = 0; i < mostLifts; ++i) {
        if (!goOn()) return planet::cancelled();
        const planet::ViewInput input = flown.viewAt(flown.path.keys.front().timeS);
        if (!flown.planet.settle({&input, 1}, planet::noUpload, settleTimeoutS)) return loadingTimedOut();
        flown.dropTileChanges();
        if (flown.viewAt(flown.path.keys.front().timeS).lodView == input.lodView) break;
    }
    return {};
}

planet::PrefetchCounters prefetchedSince(const planet::PrefetchCounters& before,
                                         planet::PrefetchCounters now) {
    now.blocks -= before.blocks;
    now.bytes -= before.bytes;
    now.hits -= before.hits;
    now.hitBytes -= before.hitBytes;
    now.wasted -= before.wasted;
    now.wastedBytes -= before.wastedBytes;
    return now;
}

}  // namespace

Result<PrefetchFigures> flyForPrefetch(planet::Planet& planet, const FlightPath& path,
                                       const ViewSettings& settings, const PictureSize& size,
                                       const PrefetchLeg& leg, double stepS, const KeepPrefetching& goOn) {
    const PrefetchFlight flown{planet, path, settings, size};
    planet::PagingSettings paging = pagingSettingsOf(settings, false, planet::PagingTime::Simulated);
    paging.badDisk = leg.disk;
    paging.prefetch = leg.prefetch;
    planet.tools().reset();
    if (Result<bool> set = planet.setPaging(paging); !set) return tl::unexpected(set.error());
    if (Result<void> settled = settleForPrefetch(flown, goOn); !settled)
        return tl::unexpected(settled.error());

    PrefetchFigures figures;
    const std::uint64_t bytesBefore = planet.paging().bytesRead();
    const planet::PrefetchCounters before = planet.paging().prefetch();
    const double startS = path.keys.front().timeS;
    std::optional<FlightAnnouncement> announced;
    const Result<int> frames = flightViews(path, stepS * leg.speed, mostFlightViews);
    if (!frames) return tl::unexpected(frames.error());
    for (; figures.frames < *frames; ++figures.frames) {
        if (!goOn()) return planet::cancelled();
        const double timeS = startS + figures.frames * stepS * leg.speed;
        const planet::ViewInput input = flown.viewAt(timeS);
        planet.step({&input, 1}, planet::noUpload, figures.frames > 0 ? stepS : 0);
        flown.dropTileChanges();
        const planet::SelectionCounters& selected = planet.selection().counters;
        figures.lateChunkS += stepS * selected.waiting;
        figures.drawnChunkS += stepS * selected.drawn;
        if (announced && announced->holds(timeS, leg.prefetch.horizonS, leg.speed)) continue;
        const AnnouncedFlight next = announceFlight(path, timeS, leg.speed, leg.prefetch.horizonS,
                                                    input.lodView, planet.tree().shape.radiusM);
        announced = next.announcement;
        planet.announce(next.views);
    }
    planet.announce({});
    figures.bytesRead = planet.paging().bytesRead() - bytesBefore;
    figures.prefetch = prefetchedSince(before, planet.paging().prefetch());
    return figures;
}

}  // namespace worldy
