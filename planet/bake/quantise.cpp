#include "planet/bake/quantise.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace planet {

namespace {

constexpr double lowestStep = std::numeric_limits<std::int16_t>::min();
constexpr double highestStep = std::numeric_limits<std::int16_t>::max();

// Returns the smallest of ..., 0.1, 0.2, 0.5, 1, 2, 5, ... that is not below the value.
double nextOneTwoFive(double value) {
    const double decade = std::pow(10.0, std::floor(std::log10(value)));
    for (const double digit : {1.0, 2.0, 5.0}) {
        if (digit * decade >= value) return digit * decade;
    }
    return 10 * decade;
}

double finestQuantum(double rangeM) {
    return rangeM > 0 ? nextOneTwoFive(rangeM / (highestStep - lowestStep - 2)) : 1;
}

bool holds(double baseM, double quantumM, double minM, double maxM) {
    return minM >= baseM + lowestStep * quantumM && maxM <= baseM + highestStep * quantumM;
}

}  // namespace

Result<void> chooseQuantum(const HeightSource& source, std::optional<double> wantedM, PlanetShape& shape) {
    const double rangeM = source.maxM - source.minM;
    if (wantedM && !(*wantedM > 0 && *wantedM <= 1e6)) {
        return badInput(fmt::format("quantum: {} m is out of range; expected (0, 1e6] m", *wantedM));
    }
    const bool ownStepFits = source.stepM > 0 && rangeM / source.stepM <= highestStep - lowestStep;
    shape.quantumM = wantedM.value_or(ownStepFits ? source.stepM : finestQuantum(rangeM));
    const double quantum = shape.quantumM;
    // Steps count from a possible height of the source, so that an integer source stays exact.
    const double phase = source.minM - quantum * std::floor(source.minM / quantum);
    const double lowest = source.minM - lowestStep * quantum;
    const double middle = source.minM + quantum * std::round(rangeM / 2 / quantum);
    for (const double baseM : {phase, lowest, middle}) {
        if (!holds(baseM, quantum, source.minM, source.maxM)) continue;
        shape.baseHeightM = baseM;
        return {};
    }
    // The range of an integer type can be larger than that of its image. Then the steps around 0 are used,
    // and quantise() detects heights outside.
    if (ownStepFits) {
        shape.baseHeightM = phase;
        return {};
    }
    return badInput(
        fmt::format("{}: heights in [{}, {}] m exceed 16 bits of quantum {} m; expected a quantum of at "
                    "least {} m",
                    source.description, source.minM, source.maxM, quantum, finestQuantum(rangeM)));
}

Result<void> quantise(const PlanetShape& shape, const HeightSource& source, std::span<const float> heightsM,
                      std::span<std::int16_t> steps) {
    assert(heightsM.size() == steps.size());
    const double perMetre = 1 / shape.quantumM;
    double lowestM = source.maxM;
    double highestM = source.minM;
    for (std::size_t i = 0; i < steps.size(); ++i) {
        const double height = std::clamp(static_cast<double>(heightsM[i]), source.minM, source.maxM);
        lowestM = std::min(lowestM, height);
        highestM = std::max(highestM, height);
        const double step = std::clamp((height - shape.baseHeightM) * perMetre, lowestStep, highestStep);
        // The value is made positive first, so that truncation rounds to nearest. Unlike a function call,
        // this vectorises.
        steps[i] = static_cast<std::int16_t>(static_cast<int>(step - lowestStep + 0.5) +
                                             static_cast<int>(lowestStep));
    }
    const double halfStepM = shape.quantumM / 2;
    const bool tooLow = lowestM < heightM(shape, -32768) - halfStepM;
    if (!tooLow && highestM <= heightM(shape, 32767) + halfStepM) return {};
    const double worstM = tooLow ? lowestM : highestM;
    return badInput(fmt::format(
        "{}: height {} m exceeds 16 bits of quantum {} m, [{}, {}] m; choose a larger quantum",
        source.description, worstM, shape.quantumM, heightM(shape, -32768), heightM(shape, 32767)));
}

}  // namespace planet
