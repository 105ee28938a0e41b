// The subsolar point that the settings describe. Pure functions, any thread.
#pragma once

#include "app/settings/view_settings.h"
#include "planet/sphere/cube_sphere.h"

namespace worldy {

// Returns the subsolar point, in radians, of a sun that does not follow the camera: the point of its date, or
// the latitude and longitude of the settings.
planet::Geographic sunOverheadOf(const SurfaceSettings& surface);

}  // namespace worldy
