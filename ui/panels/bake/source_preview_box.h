// A picture of what is to be baked, before it is.
#pragma once

#include <optional>

#include "ui/model/editor_view.h"

namespace worldy::ui {

struct PreviewBoxState {
    bool open = false;  // opens by itself once a source is changed
    planet::Face face = planet::Face::PosX;
    int zoomLog2 = 0;
    double u = 0;  // middle of what is shown, [-1, 1]
    double v = 0;
    std::optional<PreviewRequest> wanted;
    double askAtS = 0;
    bool asked = false;  // for what is wanted
};

// Asks for the picture of a request shortly after it has changed. good: the source can be opened.
void sourcePreviewBox(const EditorView& view, const BakeRequest& request, bool good, PreviewBoxState& state,
                      Commands& commands);

}  // namespace worldy::ui
