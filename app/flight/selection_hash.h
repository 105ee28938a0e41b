// A hash of what a planet draws, to check replays.
#pragma once

#include <cstdint>

#include "planet/planet.h"

namespace worldy {

// Returns the XXH3 of all selections of the planet: ids in order, and morphs to the last bit.
std::uint64_t selectionHashOf(const planet::Planet& planet);

}  // namespace worldy
