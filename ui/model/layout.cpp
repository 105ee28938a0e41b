#include "ui/model/layout.h"

#include <algorithm>
#include <cmath>

namespace worldy::ui {

namespace {

constexpr float viewportShare = 0.36f;  // of the window that docks cannot take, in each direction

bool holdsPanels(const Workspace& workspace, Dock dock) {
    return std::any_of(workspace.panels.begin(), workspace.panels.end(), [&](const PanelPlace& place) {
        return place.shown && !place.floats && place.dock == dock;
    });
}

float sizeOf(const Workspace& workspace, Dock dock, double units, float unitPx) {
    const bool isDrawn = holdsPanels(workspace, dock) && !isViewportMaximised(workspace);
    return isDrawn ? std::round(static_cast<float>(units) * unitPx) : 0;
}

void coverBy(Dock dock, Layout& layout) {
    layout.docks = {};
    layout.splitters = {};
    layout.docks[static_cast<std::size_t>(dock)] = layout.area;
    layout.viewportCovered = true;
}

}  // namespace

std::optional<Dock> maximisedDock(const Workspace& workspace) {
    if (workspace.maximised == MaximisedDock::None || isViewportMaximised(workspace)) return std::nullopt;
    const auto dock = static_cast<Dock>(static_cast<int>(workspace.maximised) - 1);
    return holdsPanels(workspace, dock) ? std::optional(dock) : std::nullopt;
}

bool isViewportMaximised(const Workspace& workspace) {
    return workspace.maximised == MaximisedDock::Viewport;
}

double fittingScale(double scale, float windowWidth, float windowHeight, float fontPx) {
    const float most = std::min(windowWidth / 45, windowHeight / 28) / fontPx;
    return std::min(scale, std::max(static_cast<double>(most), 1.0));
}

Layout layoutOf(float windowWidth, float windowHeight, const Workspace& workspace, float menuHeight,
                float statusHeight, float unitPx) {
    // A minimised window has no size.
    const float width = std::max(windowWidth, 64.0f);
    const float height = std::max(windowHeight - menuHeight - statusHeight, 64.0f);
    const float bar = std::max(std::round(5 * unitPx), 3.0f);
    float left = sizeOf(workspace, Dock::Left, workspace.leftWidth, unitPx);
    float right = sizeOf(workspace, Dock::Right, workspace.rightWidth, unitPx);
    float bottom = sizeOf(workspace, Dock::Bottom, workspace.bottomHeight, unitPx);
    const float leftBar = left > 0 ? bar : 0;
    const float rightBar = right > 0 ? bar : 0;
    const float bottomBar = bottom > 0 ? bar : 0;
    const float room = width * (1 - viewportShare) - leftBar - rightBar;
    if (left + right > room) {
        left = std::floor(left * room / (left + right));
        right = right > 0 ? std::floor(room) - left : 0;
    }
    bottom = std::min(bottom, std::floor(height * (1 - viewportShare)) - bottomBar);
    if (bottomBar == 0) bottom = 0;

    const float viewX = left + leftBar;
    const float viewWidth = width - viewX - right - rightBar;
    const float upper = height - bottom - bottomBar;
    Layout layout;
    const auto dock = [&](Dock d) -> Rect& { return layout.docks[static_cast<std::size_t>(d)]; };
    const auto splitter = [&](Dock d) -> Rect& { return layout.splitters[static_cast<std::size_t>(d)]; };
    layout.menuBar = {0, 0, width, menuHeight};
    layout.viewport = {viewX, menuHeight, viewWidth, upper};
    dock(Dock::Left) = {0, menuHeight, left, upper};
    splitter(Dock::Left) = {left, menuHeight, leftBar, upper};
    dock(Dock::Right) = {width - right, menuHeight, right, height};
    splitter(Dock::Right) = {width - right - rightBar, menuHeight, rightBar, height};
    // The bottom dock lies below the viewport and the left dock; the right dock has the full height.
    const float bottomWidth = viewX + viewWidth;
    splitter(Dock::Bottom) = {0, menuHeight + upper, bottomWidth, bottomBar};
    dock(Dock::Bottom) = {0, menuHeight + upper + bottomBar, bottomWidth, bottom};
    layout.statusBar = {0, menuHeight + height, width, statusHeight};
    layout.area = {0, menuHeight, width, height};
    if (const std::optional<Dock> maximised = maximisedDock(workspace)) coverBy(*maximised, layout);
    return layout;
}

}  // namespace worldy::ui
