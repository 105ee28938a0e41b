// Plots a sweep: cost over the largest measured error, both logarithmic, with one line per chunk size and
// metric, points labelled with tau, and rings around the Pareto front.
#pragma once

#include <span>
#include <string>

#include "app/base/picture.h"
#include "app/measure/sweep_points.h"

namespace worldy {

// A missing font is an Error.
planet::Result<Picture> plotSweep(std::span<const SweepPoint> points, SweepCost cost,
                                  const std::string& title);

}  // namespace worldy
