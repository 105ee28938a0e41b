// From heights in metres to the 16-bit steps of a chunk file. Pure functions, any thread.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "planet/source/height_source_types.h"
#include "planet/sphere/planet_shape.h"

namespace planet {

// Sets the shape's quantum and base height so that 16 bits hold every height of the source: the wanted
// quantum; else an integer source's own step, whose values are then kept exactly; else the finest 1-2-5 step
// that holds its range. The Error says which quantum would do.
Result<void> chooseQuantum(const HeightSource& source, std::optional<double> wantedM, PlanetShape& shape);

// Rounds to the nearest step. Heights beyond the source's own range, which a sharp filter gives beside a
// cliff, are cut to it; one that 16 bits of the quantum cannot hold is an Error.
Result<void> quantise(const PlanetShape& shape, const HeightSource& source, std::span<const float> heightsM,
                      std::span<std::int16_t> steps);

}  // namespace planet
