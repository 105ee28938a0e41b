#include "app/editor/presets.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "app/base/output_file.h"
#include "app/base/places.h"
#include "app/base/utf8.h"
#include "app/data/write_check.h"

namespace worldy {

namespace {

namespace fs = std::filesystem;
using planet::Result;

constexpr std::size_t maxNameBytes = 60;
constexpr std::string_view presetEnding = ".toml";

// Lower-cases ASCII letters, which is enough to detect clashes on file systems that ignore case.
std::string lowered(std::string_view text) {
    std::string lower(text);
    for (char& letter : lower) {
        if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
    }
    return lower;
}

bool isControl(char letter) {
    return static_cast<unsigned char>(letter) < 0x20 || letter == 0x7F;
}

tl::unexpected<planet::Error> wrongName(std::string_view name, std::string_view why) {
    return planet::badInput(fmt::format("name \"{:.80}\": {}", name, why));
}

}  // namespace

PresetFolders presetFolders() {
    return {dataFolder() / "presets", configFolder() / "presets"};
}

Result<void> checkPresetName(std::string_view name) {
    if (name.empty()) return planet::badInput("name: empty; expected letters, digits and spaces");
    if (name.size() > maxNameBytes)
        return wrongName(name, fmt::format("{} bytes; expected 1 to {}", name.size(), maxNameBytes));
    if (!isUtf8(name)) return planet::badInput("name: not UTF-8; expected UTF-8 text");
    if (std::any_of(name.begin(), name.end(), isControl))
        return planet::badInput("name: contains control characters; expected printable text");
    if (name.find_first_of("/\\:*?\"<>|") != std::string_view::npos)
        return wrongName(name, "contains one of / \\ : * ? \" < > |; expected none of them");
    if (std::string_view(". ").find(name.front()) != std::string_view::npos ||
        std::string_view(". ").find(name.back()) != std::string_view::npos) {
        return wrongName(name, "begins or ends with a dot or a space; expected neither");
    }
    return {};
}

PresetLibrary::PresetLibrary(PresetFolders folders) : folders_(std::move(folders)) {
    reload();
}

void PresetLibrary::reload() {
    presets_.clear();
    viewsOf_.reset();
    readFolder(folders_.shipped, true);
    readFolder(folders_.own, false);
    std::stable_sort(presets_.begin(), presets_.end(), [](const Preset& a, const Preset& b) {
        return std::pair(!a.shipped, lowered(a.name)) < std::pair(!b.shipped, lowered(b.name));
    });
}

void PresetLibrary::readFolder(const fs::path& folder, bool shipped) {
    std::error_code status;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, status)) {
        const std::string file = entry.path().filename().string();
        // Hidden files are unfinished or belong to an editor.
        if (!file.ends_with(presetEnding) || file.starts_with('.') || !isUtf8(file)) continue;
        const std::string name = file.substr(0, file.size() - presetEnding.size());
        Result<ViewPart> part = loadViewPart(entry.path());
        if (const Preset* same = find(name); same && same->shipped) {
            part = planet::badInput(
                fmt::format("{}: a built-in preset has that name; rename the file", entry.path().string()));
        }
        presets_.push_back({name, entry.path(), shipped, std::move(part)});
    }
}

std::span<const ui::PresetView> PresetLibrary::views(const ViewSettings& now) {
    if (viewsOf_ == now) return views_;
    viewsOf_ = now;
    views_.clear();
    for (const Preset& preset : presets_) {
        ui::PresetView view{preset.name, preset.file, {}, {}, preset.shipped};
        if (preset.part)
            view.differences = differences(now, *preset.part);
        else
            view.problem = preset.part.error().message;
        views_.push_back(std::move(view));
    }
    return views_;
}

const PresetLibrary::Preset* PresetLibrary::find(std::string_view name) const {
    const auto found = std::find_if(presets_.begin(), presets_.end(), [&](const Preset& preset) {
        return lowered(preset.name) == lowered(name);
    });
    return found == presets_.end() ? nullptr : &*found;
}

Result<const PresetLibrary::Preset*> PresetLibrary::existing(std::string_view name) const {
    const auto found = std::find_if(presets_.begin(), presets_.end(),
                                    [&](const Preset& preset) { return preset.name == name; });
    if (found != presets_.end()) return &*found;
    return planet::badInput(fmt::format("unknown preset \"{:.80}\"; expected one in {} or {}", name,
                                        folders_.own.string(), folders_.shipped.string()));
}

Result<ViewSettings> PresetLibrary::load(std::string_view name, const ViewSettings& now) const {
    // Resetting to defaults works without the data folder.
    if (name == defaultPreset && !find(name)) return ViewSettings{};
    return existing(name).and_then([&](const Preset* preset) {
        return preset->part.map([&](const ViewPart& part) { return applied(part, now); });
    });
}

Result<void> PresetLibrary::save(std::string_view name, const ViewSettings& settings) {
    if (Result<void> good = checkPresetName(name); !good) return good;
    const Preset* present = find(name);
    if (present && present->shipped)
        return wrongName(name,
                         "a built-in preset has that name and cannot be replaced; expected another name");
    std::error_code status;
    fs::create_directories(folders_.own, status);
    // A name that differs only in case overwrites the existing file and keeps its name.
    const fs::path file =
        present ? present->file : folders_.own / (std::string(name) + std::string(presetEnding));
    // Other files in the folder, such as flights, are not overwritten.
    if (Result<void> kind = checkKinds({{file, OutputKind::Preset}}); !kind) return kind;
    Result<void> written = writeTextFile(file, viewSettingsText(settings));
    reload();
    return written;
}

Result<void> PresetLibrary::remove(std::string_view name) {
    const Result<const Preset*> preset = existing(name);
    if (!preset) return tl::unexpected(preset.error());
    if ((*preset)->shipped) {
        return planet::badInput(
            fmt::format("The preset \"{}\" is built-in and cannot be deleted", (*preset)->name));
    }
    const fs::path file = (*preset)->file;
    std::error_code status;
    fs::remove(file, status);
    reload();
    if (status)
        return planet::ioError(fmt::format("{}: cannot be deleted: {}", file.string(), status.message()));
    return {};
}

}  // namespace worldy
