#include "app/settings/sun_overhead.h"

#include <glm/trigonometric.hpp>

#include "planet/sphere/sun.h"

namespace worldy {

planet::Geographic sunOverheadOf(const SurfaceSettings& surface) {
    if (surface.sunByDate) return planet::sunOverhead(surface.sunDate);
    return {glm::radians(surface.sunLatitudeDeg), glm::radians(surface.sunLongitudeDeg)};
}

}  // namespace worldy
