#include "app/scene/costly_parts.h"

namespace worldy {

using planet::gl::FeatureUse;

FeatureUse& useOf(CostlyPart part, SurfaceSettings& surface) {
    switch (part) {
        case CostlyPart::Air:
            return surface.light.air.use;
        case CostlyPart::Normals:
            return surface.light.normals.use;
        case CostlyPart::Layers:
            return surface.layers.use;
        case CostlyPart::Shadows:
            return surface.light.shadows.use;
        case CostlyPart::Sea:
            return surface.light.sea.use;
        case CostlyPart::Detail:
            break;
    }
    return surface.detail;
}

void turnDown(const TurnedDown& turnedDown, SurfaceSettings& surface) {
    for (std::size_t i = 0; i < costlyPartCount; ++i) {
        FeatureUse& use = useOf(static_cast<CostlyPart>(i), surface);
        if (turnedDown.parts[i] && use == FeatureUse::Automatic) use = FeatureUse::Off;
    }
}

bool watchPicture(TurnedDown& turnedDown, const SurfaceSettings& surface, double gpuMs, double timeS) {
    if (gpuMs <= affordedMs) turnedDown.fastAtS = timeS;
    if (timeS - turnedDown.fastAtS < patienceS) return false;
    turnedDown.fastAtS = timeS;
    SurfaceSettings copy = surface;
    for (std::size_t i = 0; i < costlyPartCount; ++i) {
        if (turnedDown.parts[i] || useOf(static_cast<CostlyPart>(i), copy) != FeatureUse::Automatic) continue;
        turnedDown.parts[i] = true;
        turnedDown.tookMs[i] = gpuMs;
        return true;
    }
    return false;
}

}  // namespace worldy
