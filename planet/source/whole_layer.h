// Describes sources that are one layer (source_layers.h). Internal to the library; any thread.
#pragma once

#include <functional>
#include <memory>

#include "planet/base/result.h"
#include "planet/source/height_source_types.h"
#include "planet/source/source_layers.h"

namespace planet {

// Returns the layers of a source that is one layer. at: its reading of a place.
std::shared_ptr<const SourceLayers> singleLayer(
    SourceLayer layer, std::function<Result<SourceReading>(const Geographic& place)> at);

// Describes a source that covers the planet; its sample and missing counts must be set.
SourceLayer wholeLayer(const HeightSource& source, LayerKind kind, double spacingRad);

}  // namespace planet
