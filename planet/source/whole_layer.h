// Describes sources that are one layer (source_layers.h). Internal to the library; any thread.
#pragma once

#include <functional>
#include <memory>
#include <span>

#include "planet/base/result.h"
#include "planet/source/height_source_types.h"
#include "planet/source/source_layers.h"

namespace planet {

// Returns the layers of a source that is one layer. at: its reading of a place.
std::shared_ptr<const SourceLayers> singleLayer(
    SourceLayer layer, std::function<Result<SourceReading>(const Geographic& place)> at);

// Describes a source that covers the planet; its sample and missing counts must be set.
SourceLayer wholeLayer(const HeightSource& source, LayerKind kind, double spacingRad);

// Returns the height of a source at the nearest point of the grid of its natural face size.
Result<SourceReading> readGridPoint(
    const std::function<Result<void>(const SampleTile& tile, std::span<float> out)>& sample,
    int naturalFaceSize, const Geographic& place);

}  // namespace planet
