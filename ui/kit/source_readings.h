// A table that says which source made the height of a place, and what lies under it.
#pragma once

#include <optional>

#include "ui/model/commands.h"
#include "ui/model/sources_view.h"

namespace worldy::ui {

// Draws the readings of a place, the top layer first, or why there are none. nothing: the text if no place was read.
void sourceReadings(const char* id, const SourcesView& sources, const std::optional<PlaceReadings>& place,
                    const char* nothing, Commands& commands);

}  // namespace worldy::ui
