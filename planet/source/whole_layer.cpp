#include "planet/source/whole_layer.h"

#include <string>
#include <utility>
#include <vector>

#include "planet/base/try.h"

namespace planet {

std::shared_ptr<const SourceLayers> singleLayer(
    SourceLayer layer, std::function<Result<SourceReading>(const Geographic& place)> at) {
    auto layers = std::make_shared<SourceLayers>();
    layers->layers.push_back(std::move(layer));
    layers->at = [at = std::move(at)](const Geographic& place) -> Result<std::vector<SourceReading>> {
        TRY_ASSIGN(auto reading, at(place));
        return std::vector<SourceReading>{std::move(reading)};
    };
    return layers;
}

SourceLayer wholeLayer(const HeightSource& source, LayerKind kind, double spacingRad) {
    SourceLayer layer;
    layer.name = source.description.substr(0, source.description.find(", "));
    layer.kind = kind;
    layer.about = source.description;
    layer.spacingRad = spacingRad;
    layer.sampleCount = source.sampleCount;
    layer.missingCount = source.missingCount;
    layer.coversPlanet = true;
    return layer;
}

}  // namespace planet
