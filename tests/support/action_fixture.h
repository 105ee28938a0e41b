// The data that actions read and change, without a planet, for tests of menus, keys and the palette.
#pragma once

#include "tests/support/empty_view.h"
#include "ui/shell/actions.h"

namespace worldy::ui {

struct ActionBench : EmptyView {
    ViewSettings settings{};
    Workspace workspace{};
    MenuState menu{};
    ActionKeys keys = defaultKeys();
    Commands commands{};

    ActionContext context() { return {view, settings, workspace, menu, keys, commands}; }
};

}  // namespace worldy::ui
