// The entries of the palette: actions and their choices, panels, settings, and the chunk or place that is typed.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "ui/model/palette_search.h"
#include "ui/shell/actions.h"

namespace worldy::ui {

// The effects of choosing an entry.
struct PaletteChoice {
    std::function<void(const ActionContext&)>
        choose{};  // empty for a setting, which is edited in the palette
    std::function<void(const ActionContext&)> lookAt{};  // with Ctrl; empty: as without
    std::string setting{};                               // its name; empty: it is none
};

// The two lists are parallel.
struct PaletteItems {
    std::vector<PaletteEntry> entries;
    std::vector<PaletteChoice> choices;
};
PaletteItems paletteItems(std::string_view query, const ActionContext& context);

}  // namespace worldy::ui
