// Measures the jump of the surface at each level change over a flight, for the command pops and for
// comparisons. All loads are on time, and the first view is settled before the first frame is measured. A sea
// that is drawn as water hides its bed. Draws nothing.
#pragma once

#include <functional>
#include <vector>

#include "app/flight/flight_path.h"
#include "app/settings/camera_text.h"
#include "app/settings/view_settings.h"
#include "planet/measure/pop_meter.h"
#include "planet/planet.h"

namespace worldy {

struct PopsFlight {
    std::vector<planet::PopEvent> events;  // events of the whole flight
    planet::PopTotals totals;
    double usPerSwitch = 0;  // time to measure one level change
    int frames = 0;
    bool seaSurfaceDrawn = false;  // the sea is drawn as water
};

inline constexpr int mostPopsFrames = 10'000'000;

// Called often with the completed share, [0, 1]. Returning false ends the flight with an Error of kind
// Cancelled.
using PopsFlightWatch = std::function<bool(double share)>;

// stepS: seconds of the flight between two frames, > 0. software: the CPU draws, so an Automatic sea is not
// drawn as water.
planet::Result<PopsFlight> flyForPops(planet::Planet& planet, const FlightPath& path,
                                      const ViewSettings& settings, const PictureSize& size, double stepS,
                                      bool software, const PopsFlightWatch& goOn);

// Returns the largest jump in pixels of each level change that counts (planet::counts), ascending.
std::vector<double> jumpsOf(const PopsFlight& flown);

}  // namespace worldy
