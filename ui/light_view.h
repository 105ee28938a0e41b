// What the Light panel knows of the picture.
#pragma once

#include "planet/gl/light_drawing.h"

namespace ui {

struct LightView {
    bool software = false;  // the CPU draws: what is Automatic is turned down
    planet::gl::AirFigures air;
};

}  // namespace ui
