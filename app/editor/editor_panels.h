// The panels' part of a frame of the window: what they may read is gathered, and they are drawn around the
// pictures.

#include "app/editor/editor_state.h"
#include "app/editor/session.h"
#include "ui/model/commands.h"
#include "ui/model/editor_view.h"
#include "ui/model/layout.h"
#pragma once

namespace worldy {

// Points into the session and the editor; holds for the frame.
ui::EditorView gatherView(Session& session, Editor& editor);

void drawPanels(const Session& session, const ui::EditorView& view, const ui::Layout& layout,
                float pixelRatio, Editor& editor, ui::Commands& commands);

}  // namespace worldy
