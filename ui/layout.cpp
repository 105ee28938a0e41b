#include "ui/layout.h"

#include <algorithm>
#include <cmath>

namespace ui {

Layout layoutOf(float windowWidth, float windowHeight, const PanelSizes& sizes, float unitPx) {
    windowWidth = std::max(windowWidth, 16.0f);  // a minimised window has no size at all
    windowHeight = std::max(windowHeight, 16.0f);
    const float splitter = std::max(std::round(5 * unitPx), 3.0f);
    const float lodWidth =
        std::round(std::min(static_cast<float>(sizes.lodWidth) * unitPx, windowWidth * 0.6f - splitter));
    const float logHeight =
        std::round(std::min(static_cast<float>(sizes.logHeight) * unitPx, windowHeight * 0.6f - splitter));
    const float viewWidth = windowWidth - lodWidth - splitter;
    const float viewHeight = windowHeight - logHeight - splitter;
    Layout layout;
    layout.viewport = {0, 0, viewWidth, viewHeight};
    layout.logSplitter = {0, viewHeight, viewWidth, splitter};
    layout.log = {0, viewHeight + splitter, viewWidth, logHeight};
    layout.lodSplitter = {viewWidth, 0, splitter, windowHeight};
    layout.lod = {viewWidth + splitter, 0, lodWidth, windowHeight};
    return layout;
}

}  // namespace ui
