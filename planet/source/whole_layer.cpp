#include "planet/source/whole_layer.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "planet/base/try.h"
#include "planet/sphere/cube_sphere.h"

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

Result<SourceReading> readGridPoint(
    const std::function<Result<void>(const SampleTile& tile, std::span<float> out)>& sample,
    int naturalFaceSize, const Geographic& place) {
    const FacePoint point = facePointFromDirection(directionFromGeographic(place));
    const int cells = naturalFaceSize - 1;
    const auto nearest = [&](double along) {
        return std::clamp(static_cast<int>(std::lround((along + 1) / 2 * cells)), 0, cells);
    };
    float height = 0;
    TRY(sample({point.face, cells, nearest(point.u), nearest(point.v), 1, 1}, std::span(&height, 1)));
    SourceReading reading;
    reading.heightM = static_cast<double>(height);
    return reading;
}

}  // namespace planet
