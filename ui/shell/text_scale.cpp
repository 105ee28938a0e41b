#include "ui/shell/text_scale.h"

#include <algorithm>
#include <limits>

namespace worldy::ui {

namespace {

double shownScale = std::numeric_limits<double>::max();

}  // namespace

void setShownTextScale(double scale) {
    shownScale = scale;
}

bool isTextLimited(const Workspace& workspace) {
    return shownScale < 0.999 * workspace.preferences.scale;
}

void zoomText(double factor, Workspace& workspace) {
    if (factor > 1 && isTextLimited(workspace)) return;
    workspace.preferences.scale =
        std::clamp(std::min(workspace.preferences.scale, shownScale) * factor, 0.5, 3.0);
}

}  // namespace worldy::ui
