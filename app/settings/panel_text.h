// The order of the tabs and the floating panels as TOML. Pure functions.
#pragma once

#include <toml++/toml.h>

#include <array>
#include <filesystem>
#include <string>
#include <string_view>

#include "app/settings/workspace.h"
#include "planet/base/result.h"

namespace worldy {

// Reads an array of panels' keys. Panels that it leaves out follow in their default order. The Error names an
// unknown panel, or one that is listed twice.
planet::Result<PanelOrder> panelOrderFromToml(const std::filesystem::path& file, std::string_view name,
                                              const toml::node& node);
std::string panelOrderText(const PanelOrder& order);

// Reads an array of tables { panel, x, y, width, height } into the panels; those that it leaves out do not
// float. On failure nothing changes.
planet::Result<void> floatingPanelsFromToml(const std::filesystem::path& file, std::string_view name,
                                            const toml::node& node,
                                            std::array<PanelPlace, panelCount>& panels);
// lineBreak, lineEnd: stand before each table, and after the last one.
std::string floatingPanelsText(const std::array<PanelPlace, panelCount>& panels, std::string_view lineBreak,
                               std::string_view lineEnd);

}  // namespace worldy
