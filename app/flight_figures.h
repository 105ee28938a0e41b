// What a setting costs, and how true what it shows is, over a flight: settled at some moments of it, evenly
// spread, so that the figures are those of the setting and not of the disk.
#pragma once

#include <functional>

#include "app/flight_path.h"
#include "app/offscreen.h"
#include "planet/finest_heights.h"

namespace worldy {

struct FlightFigures {
    int frames = 0;
    double meanTriangles = 0;
    double mostTriangles = 0;
    double meanChunks = 0;
    double mostResidentMiB = 0;    // chunks, CPU and GPU together
    double medianFrameMs = 0;      // choosing and drawing, waited for
    double worstPredictedPx = 0;   // eps, morph counted in
    double worstMeasuredPx = 0;    // true error, as if the view faced it (planet/true_error.h)
    double p99MeasuredPx = 0;      // of all chunks of all frames
    double worstScreenPx = 0;      // in the flat picture
    std::uint64_t violations = 0;  // chunks whose true error is over what was predicted
};

// Which figures are wanted: the true error reads all of the finest data in view.
enum class FigureSet : std::uint8_t { Cost, CostAndError };

// Asked before each frame; false ends with an Error of kind Cancelled.
using KeepFlying = std::function<bool()>;

// frames: at least 1. The Error names the file and what of it could not be read.
planet::Result<FlightFigures> measureFlight(Offscreen& offscreen, const FlightPath& path,
                                            const ui::ViewSettings& settings, int frames, FigureSet wanted,
                                            planet::FinestHeights& heights, const KeepFlying& goOn);

}  // namespace worldy
