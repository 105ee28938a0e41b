// The legend of the chunk tints. Pure functions.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "app/settings/view_settings.h"

namespace worldy::ui {

struct LegendEntry {
    glm::vec3 colour{0, 0, 0};
    std::string label;  // "3", "1.5 px", "12.5 m"
};
// Explains the tints, with units. Empty if chunks are not tinted.
struct Legend {
    std::string title;
    std::vector<LegendEntry> entries;
};
Legend legendOf(const OverlaySettings& overlay, double tauPx, std::uint32_t deepestLevel);

}  // namespace worldy::ui
