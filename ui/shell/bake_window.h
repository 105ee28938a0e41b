// The window in the viewport while there is no planet: the progress of a bake, or why it ended.
#pragma once

#include <string>

#include "planet/bake/bake.h"
#include "ui/model/layout.h"

namespace worldy::ui {

struct BakeWindowInput {
    std::string source;  // "elevation.tif"
    planet::BakeProgress progress;
    bool stopping = false;  // cancelled, but not finished yet
    std::string problem;    // why there is no planet; empty during a bake
    bool canBake = false;   // baking again may help
};

struct BakeWindowCommands {
    bool cancel = false;
    bool bakeAgain = false;
};

// Draws a window in the middle of a rectangle.
BakeWindowCommands bakeWindow(const BakeWindowInput& input, const Rect& within);

}  // namespace worldy::ui
