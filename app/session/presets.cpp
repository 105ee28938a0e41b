#include "app/session/presets.h"

#include <fmt/format.h>

#include <utility>

#include "app/base/output_file.h"
#include "app/base/places.h"
#include "app/data/write_check.h"

namespace worldy {

namespace {

namespace fs = std::filesystem;
using planet::Result;

constexpr std::string_view what = "preset";

}  // namespace

PresetFolders presetFolders() {
    return {dataFolder() / "presets", configFolder() / "presets"};
}

PresetLibrary::PresetLibrary(PresetFolders folders) : folders_(std::move(folders)) {
    reload();
}

void PresetLibrary::reload() {
    presets_.clear();
    viewsOf_.reset();
    for (NamedFile& named : namedFiles(folders_)) {
        Result<ViewPart> part = loadViewPart(named.file);
        if (named.isHidden) {
            part = planet::badInput(
                fmt::format("{}: a built-in preset has that name; rename the file", named.file.string()));
        }
        presets_.push_back({std::move(named), std::move(part)});
    }
}

std::span<const ui::PresetView> PresetLibrary::views(const ViewSettings& now) {
    if (viewsOf_ == now) return views_;
    viewsOf_ = now;
    views_.clear();
    for (const Preset& preset : presets_) {
        ui::PresetView view{preset.named.name, preset.named.file, {}, {}, preset.named.shipped};
        if (preset.part)
            view.differences = differences(now, *preset.part);
        else
            view.problem = preset.part.error().message;
        views_.push_back(std::move(view));
    }
    return views_;
}

Result<const PresetLibrary::Preset*> PresetLibrary::existing(std::string_view name) const {
    return itemNamed(presets_, name, folders_, what);
}

Result<ViewSettings> PresetLibrary::load(std::string_view name, const ViewSettings& now) const {
    // Resetting to defaults works without the data folder.
    if (name == defaultPreset && !existing(name)) return ViewSettings{};
    return existing(name).and_then([&](const Preset* preset) {
        return preset->part.map([&](const ViewPart& part) { return applied(part, now); });
    });
}

Result<void> PresetLibrary::save(std::string_view name, const ViewSettings& settings) {
    const Result<fs::path> file = fileToWrite(folders_, name, what);
    if (!file) return tl::unexpected(file.error());
    // Other files in the folder, such as flights, are not overwritten.
    if (Result<void> kind = checkKinds({{*file, OutputKind::Preset}}); !kind) return kind;
    Result<void> written = writeTextFile(*file, viewSettingsText(settings));
    reload();
    return written;
}

Result<void> PresetLibrary::remove(std::string_view name) {
    const Result<const Preset*> preset = existing(name);
    if (!preset) return tl::unexpected(preset.error());
    Result<void> deleted = deleteNamed((*preset)->named, what);
    reload();
    return deleted;
}

}  // namespace worldy
