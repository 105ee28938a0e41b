// Converts heights in metres to the steps of a chunk file. Pure functions, any thread.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "planet/source/height_source_types.h"
#include "planet/sphere/planet_shape.h"

namespace planet {

// Sets the shape's quantum and base height so that 16 bits hold every height of the source. The quantum is
// wantedM if set. Otherwise it is an integer source's own step, which keeps its values exactly, or else the
// finest 1-2-5 step that holds the range. The Error names a quantum that fits.
Result<void> chooseQuantum(const HeightSource& source, std::optional<double> wantedM, PlanetShape& shape);

// Divides the shape's quantum into 2^fractionBits steps, as many as the finest part of the source needs, but none finer
// than finestM, and no more than the limits of steps hold (farthestStep).
void chooseFractions(const HeightSource& source, double finestM, PlanetShape& shape);

// Returns log2 of the fractions of the file's quantum that heights are rounded to which need a quantum: the least that
// are as fine, [0, fractionBits].
int fractionBitsFor(const PlanetShape& shape, double neededM);

// Rounds to the nearest multiple of the fraction of the file's quantum that each height needs (fractionBitsFor).
// neededM: the quanta that the heights need, metres, one for each height; empty: all need the file's quantum only.
// Clamps heights to the source's range, which a sharp filter exceeds next to a cliff. A height that exceeds the limits
// of steps is an Error.
Result<void> quantise(const PlanetShape& shape, const HeightSource& source, std::span<const float> heightsM,
                      std::span<const float> neededM, std::span<std::int32_t> steps);

// Memory reused between calls.
struct SampledHeights {
    std::vector<float> heightsM;
    std::vector<float> neededM;
};

// Samples a tile of the source, and rounds its heights as quantise does.
Result<void> sampleSteps(const PlanetShape& shape, const HeightSource& source, const SampleTile& tile,
                         SampledHeights& scratch, std::span<std::int32_t> steps);

}  // namespace planet
