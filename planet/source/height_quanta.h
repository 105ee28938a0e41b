// The quanta that heights need to be stored with: how finely a source knows its heights. Pure functions apart from the
// source; any thread.
//
// An integer source needs its own step. A float source needs 1/64 of the spacing of its samples: what is finer changes
// its slopes by less than a degree.
#pragma once

#include <limits>
#include <span>

#include "planet/base/result.h"
#include "planet/source/height_source_types.h"

namespace planet {

inline constexpr double noQuantumM = std::numeric_limits<double>::infinity();  // for heights that need none

// stepM: of an integer source; 0 of a float source. spacingM: between its samples.
constexpr double neededQuantumM(double stepM, double spacingM) {
    return stepM > 0 ? stepM : spacingM / 64;
}

// Returns the finest quantum that heights of the source need, metres; noQuantumM if none needs one.
double finestQuantumOf(const HeightSource& source, double radiusM);

// Samples a tile and says which quantum each height needs.
Result<void> sampleWithQuanta(const HeightSource& source, const SampleTile& tile, double radiusM,
                              std::span<float> out, std::span<float> neededM);

}  // namespace planet
