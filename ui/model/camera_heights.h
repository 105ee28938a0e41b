// How high the camera stands, above what is drawn below it and above the ground under that. Pure functions.
#pragma once

#include <string>
#include <vector>

#include "ui/model/editor_view.h"

namespace worldy::ui {

// Metres, of the point right below the camera.
struct CameraHeights {
    double aboveDrawnM = 0;   // above the sea's surface where that is drawn, else above the ground
    double aboveGroundM = 0;  // above the finest samples that are resident, not the triangles between them
    double aboveSeaLevelM = 0;
};
CameraHeights cameraHeights(const EditorView& view, const ViewSettings& settings);

struct NamedHeight {
    std::string name;  // "above the sea bed"
    double heightM = 0;
    const char* explanation = "";
};
// The surface below the camera, then the sea bed under a drawn sea, else the sea level. Always two, so that
// what stands below them stays where it is.
std::vector<NamedHeight> namedHeights(const CameraHeights& heights);

}  // namespace worldy::ui
