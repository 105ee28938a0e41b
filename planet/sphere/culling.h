// Culls the nodes of a quadtree that lie outside a frustum or below the horizon. Internal to the library.
// Pure functions, any thread.
#pragma once

#include <array>
#include <cstdint>
#include <tuple>

#include "planet/sphere/bounds.h"
#include "planet/sphere/view.h"

namespace planet {

struct Culling {
    Frustum frustum;
    Horizon horizon;
};

// The tests that a node still needs: if a plane has the parent completely inside, it has the node inside too.
struct OpenTests {
    std::array<bool, std::tuple_size_v<Frustum>> planes{};
    bool horizon = false;
};
OpenTests openTests(bool frustumCulling, bool horizonCulling);

enum class Culled : std::uint8_t { No, ByFrustum, ByHorizon };

// Culls a node, and closes the tests that nothing within the bounds needs.
Culled cull(const Culling& culling, const ChunkBounds& bounds, OpenTests& open);

}  // namespace planet
