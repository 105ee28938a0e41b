// The height profile of the ruler: finest data and drawn surface over the distance from the first end.
#pragma once

#include <cstddef>
#include <optional>

#include "planet/measure/ground_profile.h"

namespace worldy::ui {

// Draws the profile in the available width. lines: its height, in lines of text. The pointer and the
// keyboard's cursor tell the heights at a place; the menu copies and saves them. Returns the point that is told.
std::optional<std::size_t> rulerProfile(const planet::GroundProfile& profile,
                                        const planet::ProfileSummary& summary, float lines);

}  // namespace worldy::ui
