// Announces a flight to its planet, so that what it will show can be loaded early. Pure functions, apart from the
// call to the planet.
#pragma once

#include <optional>
#include <vector>

#include "app/flight/flight_path.h"
#include "planet/planet_types.h"

namespace worldy {

// The announcements of a flight are points of a fixed grid over its time, so a new one is needed only when the
// flight has passed a point, and not in every frame.
struct FlightAnnouncement {
    double fromS = 0;   // of the flight, at the announcement
    double untilS = 0;  // the point after which the next announcement is due
    double horizonS = 0;
    double speed = 1;

    // Returns whether the announcement still holds at a time of the flight, s.
    bool holds(double timeS, double horizon, double flightSpeed) const {
        return horizon == horizonS && flightSpeed == speed && timeS >= fromS && timeS < untilS;
    }
};

struct AnnouncedFlight {
    FlightAnnouncement announcement;
    std::vector<planet::AnnouncedView> views;
};

// Returns the announcement of a flight that is at a time, s, and goes on at a speed, seconds of the flight per
// second, > 0. It covers the horizon, s, > 0, until the next announcement is due. The last view of the flight is
// announced for all times after it. like: has the size and the field of view of the picture.
AnnouncedFlight announceFlight(const FlightPath& path, double timeS, double speed, double horizonS,
                               const planet::View& like, double radiusM);

}  // namespace worldy
