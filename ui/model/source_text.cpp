#include "ui/model/source_text.h"

#include <fmt/format.h>

#include "app/base/text.h"

namespace worldy::ui {

const char* kindText(planet::LayerKind kind) {
    switch (kind) {
        case planet::LayerKind::Rasters:
            return "rasters";
        case planet::LayerKind::Image:
            return "image";
        case planet::LayerKind::Faces:
            return "six faces";
        case planet::LayerKind::Terrain:
            return "terrain";
        case planet::LayerKind::Detail:
            return "detail";
    }
    return "";
}

const char* joinText(planet::LayerJoin join) {
    return planet::nameOf(join).data();
}

std::string spacingText(const planet::SourceLayer& layer, double radiusM) {
    return layer.spacingRad > 0 ? distanceText(layer.spacingRad * radiusM) : std::string();
}

std::string voidsText(const planet::SourceLayer& layer) {
    if (layer.sampleCount == 0) return {};
    const double percent =
        100 * static_cast<double>(layer.missingCount) / static_cast<double>(layer.sampleCount);
    return layer.missingCount > 0 && percent < 0.1 ? "< 0.1 %" : fmt::format("{:.1f} %", percent);
}

std::string heightText(const planet::SourceReading& reading) {
    if (reading.heightM) return fmt::format("{:.1f} m", *reading.heightM);
    return reading.isVoid ? "void" : "not here";
}

std::string pixelText(const planet::SourceReading& reading) {
    if (reading.file.empty()) return {};
    return fmt::format("{} {}, {}", reading.file.filename().string(), reading.column, reading.row);
}

std::string stateText(const SourcesView& sources) {
    using State = SourcesView::State;
    switch (sources.state) {
        case State::Unknown:
            return "The source of this planet is not known, because it was opened from a chunk file. Open "
                   "its world file, image or rasters instead. A bake that exists is found again.";
        case State::Unread:
            return "The source has not been read yet.";
        case State::Reading:
            return "The source is being read...";
        case State::Failed:
            return sources.problem;
        case State::Read:
            break;
    }
    return {};
}

const planet::SourceLayer* descriptionOf(const SourcesView& sources, std::size_t edited) {
    if (!sources.layers || !sources.edit || edited >= sources.edit->layers.size()) return nullptr;
    const std::vector<planet::WorldLayer>& layers = sources.edit->layers;
    const std::string& name = layers[edited].name;
    std::size_t under = 0;
    for (std::size_t i = 0; i < edited; ++i) under += layers[i].name == name ? 1 : 0;
    for (const planet::SourceLayer& layer : sources.layers->layers) {
        if (layer.name == name && under-- == 0) return &layer;
    }
    return nullptr;
}

}  // namespace worldy::ui
