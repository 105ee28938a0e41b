// Presets: view settings under a name, kept as TOML files. Those that come with Worldy lie in its data
// folder and stay as they are; the user's own lie in the config folder.
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

// The shipped preset that holds every setting with its default.
inline constexpr std::string_view defaultPreset = "default";

// A name is that of a file, on any system: 1 to 60 bytes of UTF-8, no / \ : * ? " < > | or control
// characters, neither a dot nor a space at either end. The Error says what is wrong with it.
planet::Result<void> checkPresetName(std::string_view name);

// All presets, read once. Call reload() after files may have changed.
class PresetLibrary {
public:
    explicit PresetLibrary(PresetFolders folders);

    void reload();

    // For the panel: shipped ones first, then by name; files that cannot be read with their problem.
    // Differences are those from the settings as they are, and cost nothing while these stay the same.
    std::span<const ui::PresetView> views(const ViewSettings& now);

    // What a preset makes of the settings as they are: it changes only what it holds.
    planet::Result<ViewSettings> load(std::string_view name, const ViewSettings& now) const;

    // All view settings, over one of the user's own of that name, but not over a shipped one.
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
