// A flight flown with all loads on time, and how far the surface jumps at each change of level: what `worldy
// pops` and comparisons share. It begins settled: all that the first view wants is loaded, and every fade has
// ended, before the first frame is measured. A sea that is drawn as water hides the bed. Draws nothing.
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
    std::vector<planet::PopEvent> events;  // of the whole flight
    planet::PopTotals totals;
    double usPerSwitch = 0;  // time that measuring one takes
    int frames = 0;
    bool seaSurfaceDrawn = false;  // as water, which hides the bed
};

inline constexpr int mostPopsFrames = 10'000'000;

// Told again and again what share of a flight is done, [0, 1]; false ends it with an Error of kind Cancelled.
using PopsFlightWatch = std::function<bool(double share)>;

// stepS: of the flight's time between two frames, > 0. software: the CPU draws, and a sea that is Automatic
// is not drawn as water. The Error says what could not be loaded.
planet::Result<PopsFlight> flyForPops(planet::Planet& planet, const FlightPath& path,
                                      const ViewSettings& settings, const PictureSize& size, double stepS,
                                      bool software, const PopsFlightWatch& goOn);

// The largest jumps, pixels, of the switches that count (planet::counts), smallest first.
std::vector<double> jumpsOf(const PopsFlight& flown);

}  // namespace worldy
