// What the viewport shows while there is no planet to show: a bake on its way, or why it ended.
#pragma once

#include <string>

#include "planet/bake/bake.h"
#include "ui/model/layout.h"

namespace worldy::ui {

struct BakeWindowInput {
    std::string source;  // "elevation.tif"
    planet::BakeProgress progress;
    bool stopping = false;  // cancelled, but not yet at its end
    std::string problem;    // why there is no planet; empty while it bakes
    bool canBake = false;   // baking again may help
};

struct BakeWindowCommands {
    bool cancel = false;
    bool bakeAgain = false;
};

// A window of its own in the middle of a rectangle.
BakeWindowCommands bakeWindow(const BakeWindowInput& input, const Rect& within);

}  // namespace worldy::ui
