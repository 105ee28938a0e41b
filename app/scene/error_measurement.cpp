#include "app/scene/error_measurement.h"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <utility>

namespace worldy {

ErrorMeasurement measurementOf(planet::TrueErrorReport&& report) {
    ErrorMeasurement measurement;
    measurement.report = std::move(report);
    const std::vector<planet::ChunkError>& chunks = measurement.report.chunks;
    for (std::size_t i = 0; i < chunks.size(); ++i) measurement.indexOf[chunks[i].id] = i;
    measurement.worstFirst.resize(chunks.size());
    std::iota(measurement.worstFirst.begin(), measurement.worstFirst.end(), std::size_t{0});
    const auto key = [&](std::size_t i) {
        return std::tuple(!planet::isViolation(chunks[i]), -chunks[i].facingPx, chunks[i].id);
    };
    std::sort(measurement.worstFirst.begin(), measurement.worstFirst.end(),
              [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
    return measurement;
}

}  // namespace worldy
