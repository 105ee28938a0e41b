// Presets: named view settings in TOML files. Those that come with Worldy are in its data folder and are
// read-only; the user's own are in the config folder.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/settings/settings_text.h"
#include "planet/base/result.h"
#include "ui/model/editor_view.h"

namespace worldy {

struct PresetFolders {
    std::filesystem::path shipped;
    std::filesystem::path own;  // need not exist yet
};
PresetFolders presetFolders();

// The shipped preset that holds the default of every setting.
inline constexpr std::string_view defaultPreset = "default";

// Checks that a name is a valid file name on all systems: 1 to 60 bytes of UTF-8, without / \ : * ? " < >
// and control characters, and without a dot or space at either end. The Error says what is wrong.
planet::Result<void> checkPresetName(std::string_view name);

// All presets, read once. Call reload() after files may have changed.
class PresetLibrary {
public:
    explicit PresetLibrary(PresetFolders folders);

    void reload();

    // Returns the presets for the panel: shipped ones first, then by name; unreadable files with their
    // problem. The differences from now are cached until it changes.
    std::span<const ui::PresetView> views(const ViewSettings& now);

    // Returns now with the settings that the preset holds.
    planet::Result<ViewSettings> load(std::string_view name, const ViewSettings& now) const;

    // Saves all view settings. Replaces a user preset of that name, but not a shipped one.
    planet::Result<void> save(std::string_view name, const ViewSettings& settings);
    planet::Result<void> remove(std::string_view name);

private:
    struct Preset {
        std::string name;
        std::filesystem::path file;
        bool shipped = false;
        planet::Result<ViewPart> part;
    };
    void readFolder(const std::filesystem::path& folder, bool shipped);
    const Preset* find(std::string_view name) const;
    planet::Result<const Preset*> existing(std::string_view name) const;

    PresetFolders folders_;
    std::vector<Preset> presets_;
    std::vector<ui::PresetView> views_;
    std::optional<ViewSettings> viewsOf_;  // the settings that views_ were made for
};

}  // namespace worldy
