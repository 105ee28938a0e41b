#include "planet/sphere/culling.h"

namespace planet {

OpenTests openTests(bool frustumCulling, bool horizonCulling) {
    OpenTests open;
    open.planes.fill(frustumCulling);
    open.horizon = horizonCulling;
    return open;
}

Culled cull(const Culling& culling, const ChunkBounds& bounds, OpenTests& open) {
    for (std::size_t i = 0; i < open.planes.size(); ++i) {
        if (!open.planes[i]) continue;
        const Containment where = classify(bounds.box, culling.frustum[i]);
        if (where == Containment::Outside) return Culled::ByFrustum;
        open.planes[i] = where == Containment::Crossing;
    }
    if (open.horizon) {
        const Containment where = classify(bounds, culling.horizon);
        if (where == Containment::Outside) return Culled::ByHorizon;
        open.horizon = where == Containment::Crossing;
    }
    return Culled::No;
}

}  // namespace planet
