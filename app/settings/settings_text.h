// Settings as text: TOML files, assignments of single settings, and differences. Pure except for reading and
// writing files; any thread.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/settings/setting_difference.h"
#include "app/settings/settings.h"
#include "app/settings/view_settings.h"
#include "planet/base/result.h"

namespace worldy {

struct Field;

// Returns true if every setting is the same.
bool operator==(const Settings& a, const Settings& b);

// Reads a settings file. Missing keys keep the values of base. The Error names the file, the line, the key
// and the expected value.
planet::Result<Settings> loadSettings(const std::filesystem::path& file, const Settings& base = {});
// Does the same for text; place stands for the file's name in errors.
planet::Result<Settings> settingsFromText(std::string_view text, const std::filesystem::path& place,
                                          const Settings& base = {});

// Returns the file's text: every setting, below a comment with its help, allowed values and default. Equal
// settings give equal text. Colours are rounded to steps of 1 / 255.
std::string settingsText(const Settings& settings);
// Returns the text of some fields.
std::string fieldsText(std::span<const Field> fields);

planet::Result<void> saveSettings(const Settings& settings, const std::filesystem::path& file);

// Sets one setting: "lod.tau_px=3", "surface.colour=ramp", texts with or without quotes. On failure nothing
// changes, and the Error names the setting or the nearest one, and the expected value.
planet::Result<void> setSetting(Settings& settings, std::string_view assignment);
planet::Result<void> setSetting(std::span<const Field> fields, std::string_view assignment);

// Returns the view settings that differ, as text: "lod.tau_px", "2", "3".
std::vector<SettingDifference> differences(const Settings& here, const Settings& there);

// Returns the assignments for setSetting that turn the default view settings into these.
std::vector<std::string> assignmentsFor(const ViewSettings& view);

// The content of a preset's file: some or all view settings.
struct ViewPart {
    ViewSettings values;
    std::vector<std::string> names;  // of the settings it contains, "lod.tau_px"
};
// Returns every view setting as TOML. Equal settings give equal text.
std::string viewSettingsText(const ViewSettings& view);
// Reads the view settings of a file. Its other settings are checked but left out, so a settings file can be
// read too.
planet::Result<ViewPart> loadViewPart(const std::filesystem::path& file);
// Does the same for text; place stands for the file's name in errors.
planet::Result<ViewPart> viewPartFromText(std::string_view text, const std::filesystem::path& place);
// Returns the settings `now` with the values in the part.
ViewSettings applied(const ViewPart& part, const ViewSettings& now);
// Returns the settings that applying the part would change.
std::vector<SettingDifference> differences(const ViewSettings& here, const ViewPart& there);

// Returns the layout of the window as TOML: the docks and panels (isLayoutField). Equal layouts give equal text.
std::string layoutText(const Workspace& workspace);
// Reads a layout's file. What it leaves out has its default. The Error names a setting that is no part of a
// layout.
planet::Result<Workspace> loadLayout(const std::filesystem::path& file);

// Reads a preset's file and applies it to the settings `now`.
planet::Result<ViewSettings> loadViewSettings(const std::filesystem::path& file,
                                              const ViewSettings& now = {});

}  // namespace worldy
