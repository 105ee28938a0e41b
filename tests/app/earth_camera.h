// A camera over a planet of the Earth's size.
#pragma once

#include "app/scene/camera_control.h"
#include "planet/sphere/planet_shape.h"

namespace worldy {

inline Camera cameraAt(double latitudeDeg, double longitudeDeg, double altitudeM, double headingDeg,
                       double pitchDeg) {
    return cameraFromPose({latitudeDeg, longitudeDeg, altitudeM, headingDeg, pitchDeg}, planet::earthRadiusM);
}

}  // namespace worldy
