#include "app/editor/settings_controller.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "app/session/overloaded.h"
#include "app/settings/region_file.h"
#include "planet/source/terrain.h"

namespace worldy {

namespace {

namespace fs = std::filesystem;

// Return the path of the file that was saved under a name.
std::string fileOf(std::span<const ui::PresetView> presets, const std::string& name) {
    const auto preset = std::ranges::find_if(
        presets, [&](const ui::PresetView& one) { return one.name == name && !one.shipped; });
    return preset == presets.end() ? name : preset->file.string();
}
std::string fileOf(const LayoutLibrary& library, const std::string& name) {
    const auto layouts = library.layouts();
    const auto layout = std::ranges::find_if(
        layouts, [&](const NamedLayout& one) { return one.named.name == name && !one.named.shipped; });
    return layout == layouts.end() ? name : layout->named.file.string();
}

void loadPreset(SettingsController& controller, const std::string& name, Notices& notices) {
    planet::Result<ViewSettings> loaded = controller.presets.load(name, controller.settings.view);
    if (!loaded) return tellError(notices, {"The preset cannot be loaded", loaded.error().message, ""});
    replaceView(controller, std::move(*loaded), "preset " + name);
}

// Returns true if the layout can be loaded again: it is the default or a saved one.
bool isKept(const SettingsController& controller, const Workspace& workspace) {
    if (areSameLayout(workspace, {})) return true;
    const std::span<const NamedLayout> layouts = controller.layouts.layouts();
    return std::any_of(layouts.begin(), layouts.end(), [&](const NamedLayout& layout) {
        return layout.workspace && areSameLayout(workspace, *layout.workspace);
    });
}

// name: for the user.
void showLayout(SettingsController& controller, const Workspace& layout, const std::string& name,
                Notices& notices) {
    Workspace& workspace = controller.settings.workspace;
    if (!isKept(controller, workspace)) controller.unsavedLayout = workspace;
    workspace = withLayout(workspace, layout);
    show(notices, fmt::format("Layout: {}", name));
}

void restoreLayout(SettingsController& controller, Notices& notices) {
    if (!controller.unsavedLayout) return;
    const Workspace layout = *std::exchange(controller.unsavedLayout, std::nullopt);
    showLayout(controller, layout, "unsaved", notices);
}

void loadLayout(SettingsController& controller, const std::string& name, Notices& notices) {
    const planet::Result<Workspace> loaded = controller.layouts.load(name);
    if (!loaded) return tellError(notices, {"The layout cannot be loaded", loaded.error().message, ""});
    showLayout(controller, *loaded, name, notices);
}

// Shows the layout after the current one: the default, the readable saved ones, and the unsaved one.
void showNextLayout(SettingsController& controller, Notices& notices) {
    const Workspace defaults;
    struct Entry {
        std::string name;
        const Workspace* workspace;
    };
    std::vector<Entry> entries{{"default", &defaults}};
    for (const NamedLayout& layout : controller.layouts.layouts()) {
        if (layout.workspace) entries.push_back({layout.named.name, &*layout.workspace});
    }
    const Workspace& now = controller.settings.workspace;
    const auto current = std::find_if(entries.begin(), entries.end(), [&](const Entry& entry) {
        return areSameLayout(now, *entry.workspace);
    });
    const bool isLast = current != entries.end() && current + 1 == entries.end();
    if (isLast && controller.unsavedLayout) return restoreLayout(controller, notices);
    // A layout that is not saved counts as the last one.
    const Entry next = current == entries.end() || isLast ? entries.front() : *(current + 1);
    showLayout(controller, Workspace(*next.workspace), next.name, notices);
}

void saveRegions(SettingsController& controller, const fs::path& asked, Notices& notices) {
    RegionSettings& regions = controller.settings.view.regions;
    const fs::path named = !regions.file.empty() ? fs::path(regions.file) : controller.regions.beside;
    const fs::path& file = asked.empty() ? named : asked;
    if (!succeeded(notices, worldy::saveRegions(regions.all(), file), "The regions were not saved")) return;
    regions.file = file.string();
    controller.regions.saved = regions.list;
    confirm(notices, fmt::format("Regions saved: {}", file.string()));
}

void loadRegionsInto(SettingsController& controller, const fs::path& file, Notices& notices) {
    planet::Result<RegionSettings> loaded = regionsFor(file, {});
    if (!loaded) return tellError(notices, {"The regions cannot be read", loaded.error().message, ""});
    ViewSettings view = controller.settings.view;
    loaded->on = true;
    controller.regions.saved = loaded->list;
    view.regions = std::move(*loaded);
    replaceView(controller, std::move(view), "regions of " + file.filename().string());
    confirm(notices, fmt::format("Regions of {} loaded", file.string()));
}

bool areSaved(const SettingsController& controller) {
    const RegionSettings& regions = controller.settings.view.regions;
    const RegionSettings saved{.list = controller.regions.saved};
    return regions.list == saved.list || regions.all() == saved.all();
}

}  // namespace

void followRegions(SettingsController& controller, const DataSet& files, Notices& notices) {
    RegionFiles& now = controller.regions;
    if (now.planet == files.source) return;
    RegionSettings& regions = controller.settings.view.regions;
    const bool areGiven = now.planet.empty() && !regions.file.empty();
    const bool areLost = !now.planet.empty() && !areSaved(controller);
    now.planet = files.source;
    // The text of a terrain is no file.
    const fs::path& planetFile = planet::isTerrainText(files.source) ? files.chunkFile : files.source;
    now.beside = regionsFileOf(planetFile);
    if (areGiven) {
        now.saved = regions.list;
        return;
    }
    if (areLost) notices.log->warn("The regions of the planet before were not saved; Undo brings them back");
    planet::Result<RegionSettings> loaded = regionsFor({}, planetFile);
    if (!loaded) tellError(notices, {"The regions cannot be read", loaded.error().message, ""});
    ViewSettings view = controller.settings.view;
    view.regions = loaded ? *loaded : RegionSettings{};
    view.regions.on = regions.on;
    now.saved = view.regions.list;
    if (areLost)
        replaceView(controller, std::move(view), "regions of another planet");
    else
        controller.settings.view = std::move(view);
    if (now.saved) notices.log->info("Regions of {} loaded", now.beside.string());
}

void governFrame(SettingsController& controller, const FrameController& frames, const planet::Planet& planet,
                 double secondsSinceLast) {
    if (frames.paused && !frames.stepOnce) return;
    const std::optional<ui::FrameSample>& last = frames.history.last;
    governTau(controller.governing, last ? &last->stats : nullptr, planet, secondsSinceLast,
              controller.settings.view);
}

ViewSettings ungoverned(const SettingsController& controller, ViewSettings view) {
    if (controller.governing.ownTauPx) view.lod.tauPx = *controller.governing.ownTauPx;
    return view;
}

void execute(SettingsController& controller, const ui::SettingsCommand& command, bool replaying,
             Notices& notices) {
    ViewSettings& view = controller.settings.view;
    const auto maySet = [&] { return mayChange("Settings", replaying, notices.log); };
    std::visit(
        Overloaded{
            [&](const ui::Undo&) {
                if (!maySet()) return;
                if (const auto settings = controller.undo.undo()) view = *settings;
            },
            [&](const ui::Redo&) {
                if (!maySet()) return;
                if (const auto settings = controller.undo.redo()) view = *settings;
            },
            [&](const ui::SavePreset& preset) {
                if (succeeded(notices, controller.presets.save(preset.name, ungoverned(controller, view)),
                              "The preset was not saved"))
                    confirm(notices, fmt::format("Preset saved: {}",
                                                 fileOf(controller.presets.views(view), preset.name)));
            },
            [&](const ui::LoadPreset& preset) {
                if (maySet()) loadPreset(controller, preset.name, notices);
            },
            [&](const ui::SaveLayout& layout) {
                if (succeeded(
                        notices,
                        controller.layouts.save(layout.name, controller.settings.workspace, layout.replaces),
                        "The layout was not saved"))
                    confirm(notices,
                            fmt::format("Layout saved: {}", fileOf(controller.layouts, layout.name)));
            },
            [&](const ui::LoadLayout& layout) { loadLayout(controller, layout.name, notices); },
            [&](const ui::DeleteLayout& layout) {
                if (succeeded(notices, controller.layouts.remove(layout.name), "The layout was not deleted"))
                    confirm(notices, fmt::format("Layout {} deleted", layout.name));
            },
            [&](const ui::NextLayout&) { showNextLayout(controller, notices); },
            [&](const ui::SaveRegions& save) { saveRegions(controller, save.file, notices); },
            [&](const ui::LoadRegions& load) {
                if (maySet()) loadRegionsInto(controller, load.file, notices);
            },
            [&](const ui::ResetLayout&) { showLayout(controller, {}, "default", notices); },
            [&](const ui::RestoreLayout&) { restoreLayout(controller, notices); },
            [&](const ui::DeletePreset& preset) {
                if (succeeded(notices, controller.presets.remove(preset.name), "The preset was not deleted"))
                    confirm(notices, fmt::format("Preset {} deleted", preset.name));
            },
        },
        command);
}

void replaceView(SettingsController& controller, ViewSettings settings, std::string name) {
    controller.undo.add(ungoverned(controller, controller.settings.view), settings, std::move(name));
    controller.settings.view = std::move(settings);
}

ui::SettingsView settingsViewOf(SettingsController& controller) {
    return {controller.presets.views(ungoverned(controller, controller.settings.view)),
            controller.undo.undoName(),
            controller.undo.redoName(),
            controller.layouts.layouts(),
            controller.unsavedLayout.has_value(),
            !areSaved(controller),
            controller.settings.view.regions.file.empty() ? controller.regions.beside
                                                          : fs::path(controller.settings.view.regions.file)};
}

}  // namespace worldy
