// How high the camera stands, above what is drawn below it and above the ground under that. Pure functions.
#pragma once

#include <string>
#include <vector>

#include "ui/model/editor_view.h"

namespace ui {

// Metres, of the point right below the camera.
struct CameraHeights {
    double aboveDrawnM = 0;   // above the sea's surface where that is drawn, else above the ground
    double aboveGroundM = 0;  // above the finest ground that is resident
    double aboveSeaLevelM = 0;
};
CameraHeights cameraHeights(const EditorView& view, const ViewSettings& settings);

struct NamedHeight {
    std::string name;  // "above the sea bed"
    double heightM = 0;
    const char* explanation = "";
};
// One or two: what is drawn first. Over water that is not drawn as a surface, the bed and the sea level.
std::vector<NamedHeight> namedHeights(const CameraHeights& heights);

}  // namespace ui
