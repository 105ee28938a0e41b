// Settings for drawing texture layers, which a renderer gets per frame.
#pragma once

#include <cstdint>
#include <vector>

#include "planet/surface/feature_use.h"
#include "planet/surface/layer_set.h"

namespace planet::gl {

// Heat: the chosen layer's weight as colours over the picture. Mask: the weight alone, black to white.
enum class LayerPreview : std::uint8_t { Off, Heat, Mask };

struct LayerDrawing {
    FeatureUse use = FeatureUse::Automatic;
    LayerSet set;
    // For each layer, the index of its picture in ChunkRenderer::setLayers; -1 or missing: the checker
    // pattern.
    std::vector<int> pictures;
    double beginM = 2000;      // only the layers are seen up to this distance from the eye, metres
    double endM = 60000;       // only the ground below is seen from this distance on, metres; > beginM
    double opacity = 1;        // over the ground below, [0, 1]
    double colourBelow = 0.4;  // share of the ground's own colour that is mixed in, [0, 1]
    LayerPreview preview = LayerPreview::Off;
    int previewed = 0;  // index of a layer of the set
};

}  // namespace planet::gl
