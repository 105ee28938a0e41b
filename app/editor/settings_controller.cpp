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

void save(SettingsController& controller, const ui::SaveRegions& asked, Notices& notices) {
    RegionSettings& regions = controller.settings.view.regions;
    RegionFiles& files = controller.regions;
    files.question.clear();
    const planet::Result<RegionsSave> saved = saveRegionsIn(
        files, regions, asked.file.empty() ? fileOf(files, regions) : asked.file, asked.replaces);
    if (!saved) return tellError(notices, {"The regions were not saved", saved.error().message, ""});
    files.question = saved->question;
    if (saved->file.empty()) return;
    regions.file = saved->file.string();
    confirm(notices, fmt::format("Regions saved: {}", regions.file));
    if (saved->problem.empty()) return;
    tellError(notices, {"The regions were saved in another file", saved->problem,
                        fmt::format("This file is left as it is. The regions are in {}.", regions.file)});
}

void load(SettingsController& controller, const fs::path& file, Notices& notices) {
    ViewSettings view = controller.settings.view;
    const bool areLost = !areSaved(controller.regions, view.regions);
    planet::Result<RegionSettings> loaded = readRegions(controller.regions, file);
    if (!loaded) return tellError(notices, {"The regions cannot be read", loaded.error().message, ""});
    loaded->on = true;
    view.regions = std::move(*loaded);
    controller.regions.question.clear();
    replaceView(controller, std::move(view), "regions of " + file.filename().string());
    confirm(notices, fmt::format("Regions of {} loaded", file.string()));
    if (areLost) notices.log.warn("The regions before were not saved; Undo brings them back");
}

// Reads the regions beside a planet. Those of an earlier session in which their file could not be read are in a second one.
RegionSettings regionsBeside(RegionFiles& files, Notices& notices) {
    const fs::path second = secondRegionsFile(files.beside);
    planet::Result<RegionSettings> loaded = readRegions(files, files.beside);
    if (loaded) {
        if (loaded->list) notices.log.info("Regions of {} loaded", files.beside.string());
        if (!second.empty())
            notices.log.warn("Regions of an earlier session are in {}; open it to use them", second.string());
        return *loaded;
    }
    planet::Result<RegionSettings> earlier{RegionSettings{}};
    if (!second.empty()) earlier = readRegions(files, second);
    const std::string keeps = earlier && earlier->list
                                  ? fmt::format("The regions of {} are shown", second.filename().string())
                                  : std::string("Regions are saved in another file beside it");
    tellError(notices,
              {"The regions cannot be read", loaded.error().message,
               fmt::format("The file is left as it is. {} until it is mended and the planet is opened again.",
                           keeps)});
    return earlier ? *earlier : RegionSettings{};
}

}  // namespace

void followRegions(SettingsController& controller, const DataSet& data, Notices& notices) {
    RegionFiles& files = controller.regions;
    RegionSettings& regions = controller.settings.view.regions;
    if (files.planet == data.source) {
        files.shown = regions;
        return;
    }
    const bool areGiven = files.planet.empty() && !regions.file.empty();
    if (!files.planet.empty() && !areSaved(files, files.shown)) {
        files.shown.file = fileOf(files, files.shown).string();
        files.unsaved[files.planet] = files.shown;
        notices.log.warn("The regions in {} were not saved; they come back when their planet is opened again",
                         files.shown.file);
    }
    files.planet = data.source;
    files.question.clear();
    // The text of a terrain is no file.
    files.beside = regionsFileOf(planet::isTerrainText(data.source) ? data.chunkFile : data.source);
    const auto unsaved = files.unsaved.find(files.planet);
    if (areGiven) {
        noteRead(files, regions);
    } else {
        const bool on = regions.on;
        regions = unsaved == files.unsaved.end() ? regionsBeside(files, notices) : unsaved->second;
        regions.on = on;
    }
    if (unsaved != files.unsaved.end()) files.unsaved.erase(unsaved);
    files.shown = regions;
    controller.undo.replaceRegions(regions);
}

bool mayQuit(SettingsController& controller, const ui::Quit& quit, bool replaying, Notices& notices) {
    using Unsaved = ui::Quit::Unsaved;
    RegionFiles& files = controller.regions;
    const RegionSettings current = replaying ? files.shown : controller.settings.view.regions;
    files.quitQuestion.clear();
    if (quit.regions == Unsaved::Discard) return true;
    if (quit.regions == Unsaved::Save)
        return succeeded(notices, saveAllRegions(files, current), "The regions were not saved");
    files.quitQuestion = unsavedRegions(files, current);
    return files.quitQuestion.empty();
}

void governFrame(SettingsController& controller, const FrameController& frames, const planet::Planet& planet,
                 double secondsSinceLast) {
    if (frames.paused && !frames.stepOnce) return;
    const std::optional<ui::FrameSample>& last = frames.history.last;
    governTau(controller.governing, last ? &last->stats : nullptr, planet, secondsSinceLast,
              controller.settings.view);
}

ViewSettings ungoverned(const SettingsController& controller, ViewSettings view) {
    return ungoverned(controller.governing, std::move(view));
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
            [&](const ui::SaveRegions& asked) { save(controller, asked, notices); },
            [&](const ui::KeepRegionsFile&) { controller.regions.question.clear(); },
            [&](const ui::LoadRegions& asked) {
                if (maySet()) load(controller, asked.file, notices);
            },
            [&](const ui::KeepWindow&) { controller.regions.quitQuestion.clear(); },
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
    const RegionFiles& files = controller.regions;
    const RegionSettings& regions = controller.settings.view.regions;
    return {.presets = controller.presets.views(ungoverned(controller, controller.settings.view)),
            .undoName = controller.undo.undoName(),
            .redoName = controller.undo.redoName(),
            .layouts = controller.layouts.layouts(),
            .hasUnsavedLayout = controller.unsavedLayout.has_value(),
            .hasUnsavedRegions = !areSaved(files, regions),
            .regionsFile = fileOf(files, regions),
            .regionsQuestion = files.question,
            .quitQuestion = files.quitQuestion};
}

}  // namespace worldy
