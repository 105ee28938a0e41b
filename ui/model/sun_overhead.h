// The subsolar point that the settings describe. Pure functions, any thread.
#pragma once

#include "planet/sphere/cube_sphere.h"
#include "ui/model/view_settings.h"

namespace ui {

// Returns the subsolar point, in radians, of a sun that does not follow the camera: the point of its date, or
// the latitude and longitude of the settings.
planet::Geographic sunOverheadOf(const SurfaceSettings& surface);

}  // namespace ui
