// The legend of the chunk tints. Pure functions.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "app/scene/atlas_drape.h"
#include "app/settings/view_settings.h"
#include "planet/planet.h"
#include "planet/sphere/planet_shape.h"

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
// A region of the planet.
struct LegendRegion {
    std::string name;
    bool on = true;  // others have no colour
};
// The legends of some tints need these facts.
struct LegendFacts {
    planet::PlanetShape shape{};        // for ColourBy::LeafDepth and Spacing
    std::vector<std::string> layers{};  // for ColourBy::Source: the names from the bottom up; none: not known
    std::vector<LegendRegion> regions{};  // for ColourBy::Region
    const AtlasDrape* atlas = nullptr;    // for ColourBy::Atlas; null without one
};
std::vector<LegendRegion> legendRegions(const planet::Planet& planet);
// Returns a value of a drape with its unit: "1.24 px", or "+0.2 px" for a change.
std::string drapeText(const AtlasDrape& drape, double value);
// Returns the label of an end of the scale: "≥ 1.24 px" if some values are beyond it.
std::string scaleEndText(const AtlasDrape& drape, bool upper);
Legend legendOf(const AtlasDrape& drape);
Legend legendOf(const OverlaySettings& overlay, double tauPx, std::uint32_t deepestLevel,
                const LegendFacts& facts = {});

}  // namespace worldy::ui
