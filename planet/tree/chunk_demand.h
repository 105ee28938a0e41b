// The demand of a planet's regions (region.h) on a chunk, as plain data.
#pragma once

#include <cstdint>

#include "planet/sphere/chunk_id.h"
#include "planet/tree/error_metric.h"

namespace planet {

inline constexpr std::uint8_t noRegion = 255;

// The metric of a chunk: that of the settings, or the one that regions choose.
enum class MetricRule : std::uint8_t { AsSet, Additive, Tight };

struct ChunkDemand {
    float tauFactor = 1;          // the chunk is good enough while ε <= τ times this
    std::uint8_t leastLevel = 0;  // of a smaller level, it is split whatever its error
    // A chunk of this level or a larger one is not split, whatever its error; leastLevel comes first.
    std::uint8_t mostLevel = maxLevel;
    MetricRule metric = MetricRule::AsSet;
    // Index of the region that decides the factor or, if none does, a level or the metric.
    std::uint8_t region = noRegion;

    bool operator==(const ChunkDemand&) const = default;
};

inline ErrorMetric metricBy(MetricRule rule, ErrorMetric set) {
    if (rule == MetricRule::AsSet) return set;
    return rule == MetricRule::Tight ? ErrorMetric::Tight : ErrorMetric::Additive;
}

}  // namespace planet
