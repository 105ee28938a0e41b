// Computes the inputs of texture layers at a point of a drawn chunk, for the readout under the pointer and
// for tests of the shader. Pure functions, any thread.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>

#include "planet/sphere/chunk_id.h"
#include "planet/sphere/planet_shape.h"
#include "planet/sphere/steps.h"
#include "planet/surface/layer_set.h"

namespace planet {

// Returns the place of a point of a chunk's drawn surface, metres from the planet's centre. heights: the
// chunk's steps, without morph. Slopes are computed from the heights around each vertex, as in lighting, and
// interpolated over the triangle; at a chunk's border, from inside the chunk only. exaggeration: included in
// the shape, > 0; the returned height and slope are the true ones.
LayerPlace layerPlace(const PlanetShape& shape, const ChunkId& id, StepsView heights,
                      const glm::dvec3& positionM, double seaLevelM, double exaggeration);

}  // namespace planet
