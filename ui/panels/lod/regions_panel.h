// The Regions panel: places of the planet with detail of their own, and the brush that paints them.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <optional>
#include <string>

#include "ui/model/commands.h"
#include "ui/model/editor_view.h"
#include "ui/panels/lod/region_brush.h"

namespace worldy::ui {

struct RegionsPanelState {
    std::size_t chosen = 0;   // index of the region that the controls edit and the brush paints
    std::size_t circle = 0;   // index of its circle that the controls edit
    std::size_t polygon = 0;  // index of its polygon that a button removes
    RegionBrush brush{};
    std::optional<glm::dvec3> strokeM{};  // where the stroke that is being painted has come to
    planet::RegionPolygon corners{};      // of the polygon that is being drawn
    std::string problem{};                // why the last edit was refused; empty: it was not
};

// Fills the current window.
void regionsPanel(const EditorView& view, RegionsPanelState& state, ViewSettings& settings,
                  Commands& commands);

}  // namespace worldy::ui
