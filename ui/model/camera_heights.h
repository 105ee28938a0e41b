// The camera's heights above the drawn surface below it and above the ground. Pure functions.
#pragma once

#include <string>
#include <vector>

#include "ui/model/editor_view.h"

namespace worldy::ui {

// Heights of the camera above the point right below it, metres.
struct CameraHeights {
    double aboveDrawnM = 0;   // above the sea surface if it is drawn, otherwise above the ground
    double aboveGroundM = 0;  // above the finest resident samples, not the triangles between them
    double aboveSeaLevelM = 0;
};
CameraHeights cameraHeights(const EditorView& view, const ViewSettings& settings);

struct NamedHeight {
    std::string name;  // "above the sea bed"
    double heightM = 0;
    const char* explanation = "";
};
// Returns the height above the surface below the camera, then that above the sea bed if the sea is drawn over
// it, otherwise that above sea level. There are always two, so that the items below them do not move.
std::vector<NamedHeight> namedHeights(const CameraHeights& heights);

}  // namespace worldy::ui
