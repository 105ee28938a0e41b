// What a planet draws, as one number: whether a replay draws the same. Pure.
#pragma once

#include <cstdint>

#include "planet/planet.h"

namespace worldy {

// XXH3 over all that the planet's selections draw: ids in their order, and morphs to the last bit.
std::uint64_t selectionHashOf(const planet::Planet& planet);

}  // namespace worldy
