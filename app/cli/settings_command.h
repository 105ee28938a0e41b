// The command worldy settings: prints all settings with their ranges and defaults.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>

#include "app/settings/settings_schema.h"
#include "planet/base/result.h"

namespace worldy {

struct SettingsCommandOptions {
    bool table = false;  // prints settingsTable()
    bool json = false;   // prints settingsJson(); neither: prints a settings file
};

planet::Result<void> runSettings(const SettingsCommandOptions& options);

// Returns the content of app/SETTINGS.md: a Markdown table for each table of the settings file.
std::string settingsTable(std::span<const Field> fields);
// Returns the name, label, help, type, unit, range or values, and default of each field.
nlohmann::ordered_json settingsJson(std::span<const Field> fields);

}  // namespace worldy
