// A sweep as a picture: cost against the worst measured error, both logarithmic, a line a chunk size and
// metric, points labelled with tau, the Pareto front ringed.
#pragma once

#include <span>
#include <string>

#include "app/base/picture.h"
#include "app/measure/sweep.h"

namespace worldy {

// The Error says that no font was found to label it with.
planet::Result<Picture> plotSweep(std::span<const SweepPoint> points, SweepCost cost,
                                  const std::string& title);

}  // namespace worldy
