#include "planet/source/source_layers.h"

#include <algorithm>

namespace planet {

const SourceReading* topmost(std::span<const SourceReading> readings) {
    const auto found = std::ranges::find_if(
        readings, [](const SourceReading& reading) { return reading.heightM.has_value(); });
    return found == readings.end() ? nullptr : &*found;
}

}  // namespace planet
