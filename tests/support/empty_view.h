// An EditorView that shows nothing yet, together with the data that it refers to.
#pragma once

#include <deque>

#include "ui/model/editor_view.h"

namespace worldy::ui {

struct EmptyView {
    EmptyView() = default;
    EmptyView(const EmptyView&) = delete;
    EmptyView& operator=(const EmptyView&) = delete;

    FrameStats stats;
    std::deque<FrameSample> history;
    planet::LodChanges changes;
    std::deque<LogLine> log;
    EditorView view{
        .frames = {.stats = stats, .history = history}, .log = log, .instruments = {.changes = changes}};
};

}  // namespace worldy::ui
