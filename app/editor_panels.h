// The panels' part of a frame of the window: what they may read is gathered, and they are drawn around the
// pictures.
#pragma once

#include "app/editor.h"

namespace worldy {

// Points into the session and the editor; holds for the frame.
ui::EditorView gatherView(Session& session, Editor& editor);

void drawPanels(const Session& session, const ui::EditorView& view, const ui::Layout& layout,
                float pixelRatio, Editor& editor, ui::Commands& commands);

}  // namespace worldy
