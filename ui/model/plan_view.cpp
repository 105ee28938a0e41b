#include "ui/model/plan_view.h"

#include <algorithm>

namespace worldy::ui {

namespace {

// Around the whole content, as a share of the smaller side.
constexpr double marginShare = 0.02;

double fittingScalePx(const PlanSize& size, const Rect& area) {
    const double margin = marginShare * std::min(size.width, size.height);
    return std::max(1.0, std::min(static_cast<double>(area.width) / (size.width + 2 * margin),
                                  static_cast<double>(area.height) / (size.height + 2 * margin)));
}

}  // namespace

PlanPlacement placementOf(const PlanSize& size, const PlanFocus& focus, const Rect& area) {
    PlanPlacement placement;
    placement.scalePx = fittingScalePx(size, area) * focus.zoom;
    placement.originX =
        static_cast<double>(area.x + area.width / 2) - focus.centreX * size.width * placement.scalePx;
    placement.originY =
        static_cast<double>(area.y + area.height / 2) - focus.centreY * size.height * placement.scalePx;
    return placement;
}

PlanPoint onScreen(const PlanPlacement& placement, const PlanPoint& point) {
    return {placement.originX + point.x * placement.scalePx, placement.originY + point.y * placement.scalePx};
}

PlanPoint onPlan(const PlanPlacement& placement, double xPx, double yPx) {
    return {(xPx - placement.originX) / placement.scalePx, (yPx - placement.originY) / placement.scalePx};
}

PlanFocus movedBy(const PlanSize& size, const PlanFocus& focus, const Rect& area, double xPx, double yPx) {
    const double scalePx = fittingScalePx(size, area) * focus.zoom;
    return {focus.zoom, std::clamp(focus.centreX - xPx / (scalePx * size.width), 0.0, 1.0),
            std::clamp(focus.centreY - yPx / (scalePx * size.height), 0.0, 1.0)};
}

PlanFocus zoomedAbout(const PlanSize& size, const PlanFocus& focus, const Rect& area, double xPx, double yPx,
                      double factor) {
    const PlanPoint held = onPlan(placementOf(size, focus, area), xPx, yPx);
    PlanFocus zoomed = focus;
    zoomed.zoom = std::clamp(focus.zoom * factor, 1.0, planZoomMax);
    if (zoomed.zoom == 1) return {};
    const PlanPoint now = onScreen(placementOf(size, zoomed, area), held);
    return movedBy(size, zoomed, area, xPx - now.x, yPx - now.y);
}

PlanFocus centredOn(const PlanSize& size, const PlanFocus& focus, const Rect& area, const PlanPoint& middle,
                    double side, double leastSidePx) {
    PlanFocus centred = focus;
    centred.zoom = std::clamp(leastSidePx / (fittingScalePx(size, area) * side), focus.zoom, planZoomMax);
    centred.centreX = middle.x / size.width;
    centred.centreY = middle.y / size.height;
    return centred;
}

}  // namespace worldy::ui
