// A plane of content that is shown in a part of the screen, zoomed and moved. Pure functions, no ImGui.
#pragma once

#include "ui/model/layout.h"

namespace worldy::ui {

// Units are the content's own; x is to the right and y down, from the content's top left.
struct PlanSize {
    double width = 1;
    double height = 1;
};
struct PlanPoint {
    double x = 0;
    double y = 0;
};

// The part of the content that is in view. zoom 1: all of it.
struct PlanFocus {
    double zoom = 1;       // [1, planZoomMax]
    double centreX = 0.5;  // share of the content's width and height in the middle of the area, [0, 1]
    double centreY = 0.5;
};
inline constexpr double planZoomMax = 65536;

// The placement of the content on the screen.
struct PlanPlacement {
    double scalePx = 1;  // of a unit, pixels
    double originX = 0;  // of the content's top left, pixels
    double originY = 0;
};
PlanPlacement placementOf(const PlanSize& size, const PlanFocus& focus, const Rect& area);
PlanPoint onScreen(const PlanPlacement& placement, const PlanPoint& point);  // in pixels
PlanPoint onPlan(const PlanPlacement& placement, double xPx, double yPx);
// Zooms; the point of the content under the pointer stays under it.
PlanFocus zoomedAbout(const PlanSize& size, const PlanFocus& focus, const Rect& area, double xPx, double yPx,
                      double factor);
PlanFocus movedBy(const PlanSize& size, const PlanFocus& focus, const Rect& area, double xPx, double yPx);
// Centres a square, and zooms in if needed until its side is at least leastSidePx.
PlanFocus centredOn(const PlanSize& size, const PlanFocus& focus, const Rect& area, const PlanPoint& middle,
                    double side, double leastSidePx);

}  // namespace worldy::ui
