// Level of detail: the settings to tune, and what they cost.
#pragma once

#include "planet/view.h"
#include "ui/frame_stats.h"
#include "ui/view_settings.h"

namespace ui {

struct LodPanelInput {
    const FrameStats& stats;
    bool open = false;  // a planet is there to be measured
    planet::CameraPose camera{};
    double heightAboveGroundM = 0;
    double speedFactor = 1;
    bool hasColourImage = false;
    int openBudgetMB = 0;  // the budget that the open planet runs with
};

// What the panel asks the application to do.
struct LodPanelCommands {
    bool toggleFreeze = false;
    bool resetCamera = false;
    bool keepCameraAsStart = false;
    bool applyPaging = false;  // budget or threads have changed
};

// Fills the current window.
LodPanelCommands lodPanel(const LodPanelInput& input, bool lodFrozen, ViewSettings& settings);

}  // namespace ui
