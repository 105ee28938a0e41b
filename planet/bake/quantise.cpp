#include "planet/bake/quantise.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "planet/base/try.h"
#include "planet/source/height_quanta.h"

namespace planet {

namespace {

// The file's quantum is such that 16 bits hold all its multiples.
constexpr double lowestStep = std::numeric_limits<std::int16_t>::min();
constexpr double highestStep = std::numeric_limits<std::int16_t>::max();

constexpr double slack = 1e-6;  // quanta that differ by rounding only are equal

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

void chooseFractions(const HeightSource& source, double finestM, PlanetShape& shape) {
    const double quantumM = shape.quantumM;
    const double neededM = std::max(finestM, finestQuantumOf(source, shape.radiusM));
    const double farthestM =
        std::max(std::abs(source.minM - shape.baseHeightM), std::abs(source.maxM - shape.baseHeightM));
    while (shape.fractionBits < maxFractionBits && shape.quantumM > neededM * (1 + slack) &&
           2 * farthestM / shape.quantumM <= farthestStep) {
        ++shape.fractionBits;
        shape.quantumM = std::ldexp(quantumM, -shape.fractionBits);
    }
}

int fractionBitsFor(const PlanetShape& shape, double neededM) {
    double quantumM = fileQuantumM(shape);
    int bits = 0;
    for (; bits < shape.fractionBits && quantumM > neededM * (1 + slack); ++bits) quantumM /= 2;
    return bits;
}

namespace {

struct Range {
    double lowestM = std::numeric_limits<double>::infinity();
    double highestM = -std::numeric_limits<double>::infinity();
};

// Rounds heights to multiples of 2^shift steps.
Range roundTo(const PlanetShape& shape, const HeightSource& source, std::span<const float> heightsM,
              int shift, std::span<std::int32_t> steps) {
    const double perMetre = 1 / std::ldexp(shape.quantumM, shift);
    const std::int32_t scale = 1 << shift;
    // The outermost multiples that are within the limits.
    const std::int32_t lowestMultiple = lowestStepOf(shape.fractionBits) / scale;
    const std::int32_t highestMultiple = highestStepOf(shape.fractionBits) / scale;
    const double lowest = lowestMultiple;
    const double highest = highestMultiple;
    Range range;
    for (std::size_t i = 0; i < steps.size(); ++i) {
        const double height = std::clamp(static_cast<double>(heightsM[i]), source.minM, source.maxM);
        range.lowestM = std::min(range.lowestM, height);
        range.highestM = std::max(range.highestM, height);
        const double step = std::clamp((height - shape.baseHeightM) * perMetre, lowest, highest);
        // The value is made positive first, so that truncation rounds to nearest. Unlike a function call,
        // this vectorises.
        steps[i] = (static_cast<int>(step - lowest + 0.5) + lowestMultiple) * scale;
    }
    return range;
}

// Does the same with a shift for each height, in runs of equal ones.
Range roundEach(const PlanetShape& shape, const HeightSource& source, std::span<const float> heightsM,
                std::span<const float> neededM, std::span<std::int32_t> steps) {
    Range all;
    for (std::size_t begin = 0; begin < steps.size();) {
        std::size_t end = begin + 1;
        while (end < steps.size() && neededM[end] == neededM[begin]) ++end;
        const int bits = fractionBitsFor(shape, static_cast<double>(neededM[begin]));
        const Range run = roundTo(shape, source, heightsM.subspan(begin, end - begin),
                                  shape.fractionBits - bits, steps.subspan(begin, end - begin));
        all = {std::min(all.lowestM, run.lowestM), std::max(all.highestM, run.highestM)};
        begin = end;
    }
    return all;
}

}  // namespace

Result<void> quantise(const PlanetShape& shape, const HeightSource& source, std::span<const float> heightsM,
                      std::span<const float> neededM, std::span<std::int32_t> steps) {
    assert(heightsM.size() == steps.size() && (neededM.empty() || neededM.size() == steps.size()));
    const Range range = neededM.empty() ? roundTo(shape, source, heightsM, shape.fractionBits, steps)
                                        : roundEach(shape, source, heightsM, neededM, steps);
    const double halfStepM = shape.quantumM / 2;
    const double lowestM = heightM(shape, lowestStepOf(shape.fractionBits));
    const double highestM = heightM(shape, highestStepOf(shape.fractionBits));
    const bool tooLow = range.lowestM < lowestM - halfStepM;
    if (!tooLow && !(range.highestM > highestM + halfStepM)) return {};
    const double worstM = tooLow ? range.lowestM : range.highestM;
    return badInput(fmt::format(
        "{}: height {} m exceeds {} bits of quantum {} m, [{}, {}] m; choose a larger quantum",
        source.description, worstM, shape.fractionBits == 0 ? 16 : 24, shape.quantumM, lowestM, highestM));
}

Result<void> sampleSteps(const PlanetShape& shape, const HeightSource& source, const SampleTile& tile,
                         SampledHeights& scratch, std::span<std::int32_t> steps) {
    scratch.heightsM.resize(steps.size());
    if (shape.fractionBits == 0) {
        TRY(source.sample(tile, scratch.heightsM));
        return quantise(shape, source, scratch.heightsM, {}, steps);
    }
    scratch.neededM.resize(steps.size());
    TRY(sampleWithQuanta(source, tile, shape.radiusM, scratch.heightsM, scratch.neededM));
    return quantise(shape, source, scratch.heightsM, scratch.neededM, steps);
}

}  // namespace planet
