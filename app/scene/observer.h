// The observer: a second camera that looks at the LOD view from outside. Pure functions, any thread.
#pragma once

#include <optional>

#include "app/scene/camera_control.h"
#include "app/settings/view_settings.h"
#include "planet/gl/draw/debug_shapes.h"
#include "planet/planet.h"

namespace worldy {

// Returns the first pose of the observer: behind and above the eye of the LOD view, looking at that eye and
// at the ground in front of it. ground: the ground below that eye.
Camera observerStart(const planet::View& lodView, const Ground& ground);

// Returns the lines that the settings ask for: a mark at the eye of the LOD view, its frustum, its horizon,
// and the switch distance of the selected chunk. The latter are outlines, in three planes, of all points at
// which the chunk is replaced by its children.
planet::Lines observerLines(const planet::Planet& planet, const planet::View& lodView,
                            const CameraSettings& settings, const std::optional<planet::ChunkId>& selected);

// Returns the length of a drawn frustum in metres: the distance of the farthest ground or horizon in it.
double frustumLengthM(const planet::View& view, double groundRadiusM);

}  // namespace worldy
