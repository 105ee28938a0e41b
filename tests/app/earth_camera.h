// A camera over a planet of the Earth's size.
#pragma once

#include "app/camera_control.h"
#include "planet/planet_shape.h"

namespace worldy {

inline Camera cameraAt(double latitudeDeg, double longitudeDeg, double altitudeM, double headingDeg,
                       double pitchDeg) {
    return cameraFromPose({latitudeDeg, longitudeDeg, altitudeM, headingDeg, pitchDeg}, planet::earthRadiusM);
}

}  // namespace worldy
