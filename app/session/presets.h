// Presets: named view settings in TOML files. Those that come with Worldy are in its data folder and are
// read-only; the user's own are in the config folder.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/data/named_files.h"
#include "app/settings/settings_text.h"
#include "planet/base/result.h"
#include "ui/model/editor_view.h"

namespace worldy {

using PresetFolders = NamedFolders;
PresetFolders presetFolders();

// The shipped preset that holds the default of every setting.
inline constexpr std::string_view defaultPreset = "default";

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
        NamedFile named;
        planet::Result<ViewPart> part;
    };
    planet::Result<const Preset*> existing(std::string_view name) const;

    PresetFolders folders_;
    std::vector<Preset> presets_;
    std::vector<ui::PresetView> views_;
    std::optional<ViewSettings> viewsOf_;  // the settings that views_ were made for
};

}  // namespace worldy
