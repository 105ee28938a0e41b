// What the Light panel knows of the picture.
#pragma once

namespace ui {

struct LightView {
    bool software = false;  // the CPU draws: what is Automatic is turned down
};

}  // namespace ui
