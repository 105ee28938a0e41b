// How texture layers are drawn: what a renderer is told of them, frame by frame.
#pragma once

#include <cstdint>
#include <vector>

#include "planet/surface/feature_use.h"
#include "planet/surface/layer_set.h"

namespace planet::gl {

// Heat: the chosen layer's weight in colours over the picture. Mask: alone, black to white.
enum class LayerPreview : std::uint8_t { Off, Heat, Mask };

struct LayerDrawing {
    FeatureUse use = FeatureUse::Automatic;
    LayerSet set;
    // Which of the pictures given to ChunkRenderer::setLayers each layer is drawn with; -1, or none for it:
    // the checker pattern.
    std::vector<int> pictures;
    double beginM = 2000;      // from the eye: nearer than this, layers alone are seen,
    double endM = 60000;       // and beyond this what lies below them alone; > beginM
    double opacity = 1;        // over what lies below, [0, 1]
    double colourBelow = 0.4;  // how much of its colour goes through them, [0, 1]
    LayerPreview preview = LayerPreview::Off;
    int previewed = 0;  // a layer of the set
};

}  // namespace planet::gl
