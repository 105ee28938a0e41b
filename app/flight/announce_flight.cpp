#include "app/flight/announce_flight.h"

#include <cassert>
#include <cmath>

namespace worldy {

AnnouncedFlight announceFlight(const FlightPath& path, double timeS, double speed, double horizonS,
                               const planet::View& like, double radiusM) {
    assert(speed > 0 && horizonS > 0);
    constexpr int pointsAhead = 8;
    const double spacingS = horizonS * speed / pointsAhead;  // of the flight
    const double next = std::floor(timeS / spacingS) + 1;
    AnnouncedFlight announced{{timeS, next * spacingS, horizonS, speed}, {}};
    for (int i = 0; i <= pointsAhead; ++i) {
        const double pointS = (next + i) * spacingS;
        announced.views.push_back({planet::viewFromPose(poseAt(path, pointS), radiusM, like.horizontalFovRad,
                                                        like.widthPx, like.heightPx),
                                   (pointS - timeS) / speed});
    }
    return announced;
}

}  // namespace worldy
