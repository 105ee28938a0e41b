// Measures the cost of a setting and its true error over a flight. The planet is settled at each of some
// evenly spaced sample frames, so that the figures are those of the setting and not of the disk.
#pragma once

#include <functional>

#include "app/flight/flight_figures.h"
#include "app/flight/flight_path.h"
#include "app/scene/offscreen.h"
#include "planet/paging/finest_heights.h"

namespace worldy {

// Which figures are wanted: the true error reads all of the finest data in view.
enum class FigureSet : std::uint8_t { Cost, CostAndError };

// Asked before each frame, and several times a second while it is settled and measured, then from any thread,
// with its number from 0; false ends with an Error of kind Cancelled.
using KeepFlying = std::function<bool(int frame)>;

// Looks at each moment once its figures are there. An Error ends the flight.
using AtMoment = std::function<planet::Result<void>(Offscreen& offscreen, const SettledView& at)>;

// The Error names the file and what of it could not be read.
planet::Result<FlightFigures> measureFlight(Offscreen& offscreen, const FlightPath& path,
                                            const ViewSettings& settings, const FlightFrames& frames,
                                            FigureSet wanted, planet::FinestHeights& heights,
                                            const KeepFlying& goOn, const AtMoment& atMoment = {});

}  // namespace worldy
