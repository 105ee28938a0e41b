// LOD settings for tests of single steps: chunks change levels at once, without morph, fade or hysteresis.
#pragma once

#include "planet/select/lod_types.h"

namespace planet {

inline LodSettings suddenLod(double tauPx = 2) {
    LodSettings settings;
    settings.tauPx = tauPx;
    settings.hysteresis = 0;
    settings.morph = false;
    settings.fadeS = 0;
    return settings;
}

}  // namespace planet
