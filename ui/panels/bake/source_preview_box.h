// A preview of the terrain to be baked.
#pragma once

#include <optional>

#include "ui/model/editor_view.h"

namespace worldy::ui {

struct PreviewBoxState {
    bool open = false;  // set when the source is edited
    planet::Face face = planet::Face::PosX;
    int zoomLog2 = 0;
    double u = 0;  // centre of the shown square, [-1, 1]
    double v = 0;
    std::optional<PreviewRequest> wanted;
    double askAtS = 0;
    bool asked = false;  // wanted has been requested
};

// Draws the preview and requests a new picture shortly after the request has changed. good: the source can be
// opened.
void sourcePreviewBox(const EditorView& view, const BakeRequest& request, bool good, PreviewBoxState& state,
                      Commands& commands);

}  // namespace worldy::ui
