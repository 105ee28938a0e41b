// Converts heights in metres to the 16-bit steps of a chunk file. Pure functions, any thread.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "planet/source/height_source_types.h"
#include "planet/sphere/planet_shape.h"

namespace planet {

// Sets the shape's quantum and base height so that 16 bits hold every height of the source. The quantum is
// wantedM if set. Otherwise it is an integer source's own step, which keeps its values exactly, or else the
// finest 1-2-5 step that holds the range. The Error names a quantum that fits.
Result<void> chooseQuantum(const HeightSource& source, std::optional<double> wantedM, PlanetShape& shape);

// Rounds to the nearest step. Clamps heights to the source's range, which a sharp filter exceeds next to a
// cliff. A height that does not fit into 16 bits is an Error.
Result<void> quantise(const PlanetShape& shape, const HeightSource& source, std::span<const float> heightsM,
                      std::span<std::int16_t> steps);

}  // namespace planet
