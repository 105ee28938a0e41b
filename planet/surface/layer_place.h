// What texture layers look at, of a point on a drawn chunk: for the readout under the pointer, and for tests
// that hold the shader to it. Pure functions, any thread.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>

#include "planet/sphere/chunk_id.h"
#include "planet/sphere/planet_shape.h"
#include "planet/surface/layer_set.h"

namespace planet {

// Of a point of a chunk's surface as it is drawn, metres from the planet's centre. heights: the chunk's
// steps, its morph left out. Slopes follow from the heights beside each vertex, as light does, and are mixed
// over a triangle; at a chunk's border from those inside alone. exaggeration: in the shape already; the
// place's height and slope are the true ones. > 0.
LayerPlace layerPlace(const PlanetShape& shape, const ChunkId& id, std::span<const std::int16_t> heights,
                      const glm::dvec3& positionM, double seaLevelM, double exaggeration);

}  // namespace planet
