// What a view cannot see of a quadtree: nodes outside its frustum or below the horizon. Internal to the
// library. Pure functions, any thread.
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

// The tests a node still has to take: one that holds its parent wholly holds it too.
struct OpenTests {
    std::array<bool, std::tuple_size_v<Frustum>> planes{};
    bool horizon = false;
};
OpenTests openTests(bool frustumCulling, bool horizonCulling);

enum class Culled : std::uint8_t { No, ByFrustum, ByHorizon };

// Closes the tests that nothing under the bounds need take.
Culled cull(const Culling& culling, const ChunkBounds& bounds, OpenTests& open);

}  // namespace planet
