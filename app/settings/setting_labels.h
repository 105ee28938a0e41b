// The labels of settings: the words that the panels' controls show. Pure functions.
#pragma once

#include <string_view>

namespace worldy {

// Returns the label of a view setting, as "Tolerance τ" of "lod.tau_px", with the panel's topic where two
// controls have the same label; of another setting its name.
std::string_view settingLabel(std::string_view name);

}  // namespace worldy
