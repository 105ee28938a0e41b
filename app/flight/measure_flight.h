// Measures the cost and the error of settings over a flight. Each sample frame is settled first, so that the
// figures do not depend on the disk.
#pragma once

#include <functional>

#include "app/flight/flight_figures.h"
#include "app/flight/flight_path.h"
#include "app/scene/offscreen.h"
#include "planet/paging/finest_heights.h"

namespace worldy {

// The figures to measure. The true error takes longer, because it reads all of the finest data in view.
enum class FigureSet : std::uint8_t { Cost, CostAndError };

// Called before each frame, with its index, and several times per second while the frame is settled and
// measured, then from any thread. Returning false ends the flight with an Error of kind Cancelled.
using KeepFlying = std::function<bool(int frame)>;

// Called for each sample frame after its figures are measured. An Error ends the flight.
using AtMoment = std::function<planet::Result<void>(Offscreen& offscreen, const SettledView& at)>;

planet::Result<FlightFigures> measureFlight(Offscreen& offscreen, const FlightPath& path,
                                            const ViewSettings& settings, const FlightFrames& frames,
                                            FigureSet wanted, planet::FinestHeights& heights,
                                            const KeepFlying& goOn, const AtMoment& atMoment = {});

}  // namespace worldy
