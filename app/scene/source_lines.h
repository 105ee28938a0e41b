// Turns the coverage of a source's layers into lines over the planet and places to look at. Pure functions, any thread.
#pragma once

#include "planet/gl/draw/debug_shapes.h"
#include "planet/planet.h"
#include "planet/source/source_layers.h"

namespace worldy {

// Returns the outlines of the layers on the ground, lifted off it by about two pixels, in the layers' colours. What lies
// behind the horizon is left out.
planet::Lines sourceLines(const planet::SourceLayers& source, const planet::ChunkTree& tree,
                          const planet::View& view);

// Returns the arc from the middle of what a layer covers to its farthest point, radians; half a turn if the layer covers
// the planet.
double reachRad(const planet::SourceLayer& layer);

// Returns a camera above the middle of what a layer covers, from which all of it can be seen.
planet::CameraPose poseOver(const planet::SourceLayer& layer, const planet::ChunkTree& tree);

}  // namespace worldy
