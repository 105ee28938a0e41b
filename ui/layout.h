// Where the window's parts lie. Pure functions.
#pragma once

namespace ui {

// Sizes that the splitters change, in units of a font of 13 pixels, so that they fit any monitor.
struct PanelSizes {
    double lodWidth = 310;   // [160, 1000]
    double logHeight = 150;  // [60, 1000]
};

struct Rect {
    float x = 0;  // pixels from the window's top left
    float y = 0;
    float width = 0;
    float height = 0;
};

struct Layout {
    Rect viewport;
    Rect log;
    Rect lod;
    Rect lodSplitter;
    Rect logSplitter;
};

// The viewport keeps at least a third of the window each way, however large the panels are asked to be.
Layout layoutOf(float windowWidth, float windowHeight, const PanelSizes& sizes, float unitPx);

}  // namespace ui
