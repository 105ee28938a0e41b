// The data that actions read and change, without a planet, for tests of menus, keys and the palette.
#pragma once

#include <deque>

#include "ui/shell/actions.h"

namespace worldy::ui {

struct ActionBench {
    FrameStats stats{};
    std::deque<FrameSample> history{};
    planet::LodChanges changes{};
    std::deque<LogLine> log{};
    EditorView view{
        .frames = {.stats = stats, .history = history}, .log = log, .instruments = {.changes = changes}};
    ViewSettings settings{};
    Workspace workspace{};
    MenuState menu{};
    ActionKeys keys = defaultKeys();
    Commands commands{};

    ActionContext context() { return {view, settings, workspace, menu, keys, commands}; }
};

}  // namespace worldy::ui
