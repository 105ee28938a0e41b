#include "app/scene/error_measurement.h"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <utility>

namespace worldy {

ErrorMeasurement measurementOf(planet::TrueErrorReport&& report, ErrorMeasurement frame) {
    ErrorMeasurement measurement = std::move(frame);
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

bool drawnAlike(std::span<const planet::DrawItem> a, std::span<const planet::DrawItem> b) {
    return std::ranges::equal(a, b, [](const planet::DrawItem& one, const planet::DrawItem& other) {
        return one.id == other.id && one.morph == other.morph && one.coarserBy == other.coarserBy &&
               one.edgeMorph == other.edgeMorph;
    });
}

planet::DrawnSnapshot drawnSnapshotOf(const planet::Planet& planet) {
    const planet::ViewInput& input = planet.views()[0].input;
    return planet::snapshotOf(planet.tree(), planet.selection().draw, input.lodView,
                              input.lod.seams == planet::SeamMode::Stitched);
}

}  // namespace worldy
