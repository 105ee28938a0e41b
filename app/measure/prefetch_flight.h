// Measures what prefetching does for a flight over a simulated disk: data that is late, against bytes read. Draws
// nothing, and gives the same figures on any machine.
#pragma once

#include <cstdint>
#include <functional>

#include "app/flight/flight_path.h"
#include "app/settings/camera_text.h"
#include "app/settings/view_settings.h"
#include "planet/planet.h"

namespace worldy {

// One flight.
struct PrefetchLeg {
    planet::PrefetchSettings prefetch;
    planet::BadDiskSettings disk;
    double speed = 1;  // seconds of the flight per second, > 0
};

struct PrefetchFigures {
    int frames = 0;
    double lateChunkS =
        0;  // drawn chunks that are coarser than τ because their children are missing, x seconds
    double drawnChunkS = 0;       // all drawn chunks x seconds
    std::uint64_t bytesRead = 0;  // prefetches included
    planet::PrefetchCounters prefetch;

    bool operator==(const PrefetchFigures&) const = default;
};

// Called before each frame; returning false ends the flight with an Error of kind Cancelled.
using KeepPrefetching = std::function<bool()>;

// Flies a path in frames of stepS seconds, > 0, after the first view has settled. The planet must be opened with
// simulated time; it is reset. The paging settings of the leg replace those of `settings`.
planet::Result<PrefetchFigures> flyForPrefetch(planet::Planet& planet, const FlightPath& path,
                                               const ViewSettings& settings, const PictureSize& size,
                                               const PrefetchLeg& leg, double stepS,
                                               const KeepPrefetching& goOn);

}  // namespace worldy
