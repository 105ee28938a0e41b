// The observer: a second camera that looks at the lod view from outside, and what is drawn for it to see.
// Pure functions, any thread.
#pragma once

#include <optional>

#include "app/scene/camera_control.h"
#include "app/settings/view_settings.h"
#include "planet/gl/draw/debug_shapes.h"
#include "planet/planet.h"

namespace worldy {

// Where the observer begins: behind and above the lod view's eye, looking at it and at the ground before it.
// Ground: below that eye.
Camera observerStart(const planet::View& lodView, const Ground& ground);

// As the settings ask: the lod view's frustum, as long as to the farthest ground that it can see; its
// horizon; a mark at its eye; and how far d_m of the selected chunk reaches, as the outlines, in three
// planes, of all places from which the chunk must be replaced by its children (d_m about its bounds).
planet::Lines observerLines(const planet::Planet& planet, const planet::View& lodView,
                            const CameraSettings& settings, const std::optional<planet::ChunkId>& selected);

// How far a view's frustum is drawn, metres: to the farthest ground or horizon within it.
double frustumLengthM(const planet::View& view, double groundRadiusM);

}  // namespace worldy
