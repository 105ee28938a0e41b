#include "app/editor/settings_controller.h"

#include <fmt/format.h>

#include <utility>

#include "app/editor/overloaded.h"

namespace worldy {

namespace {

void loadPreset(SettingsController& controller, const std::string& name, Notices& notices) {
    planet::Result<ViewSettings> loaded = controller.presets.load(name, controller.settings.view);
    if (!loaded) return tellError(notices, {"The preset cannot be loaded", loaded.error().message, ""});
    replaceView(controller, std::move(*loaded), "preset " + name);
}

}  // namespace

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
                if (succeeded(notices, controller.presets.save(preset.name, view),
                              "The preset was not saved"))
                    confirm(notices, fmt::format("Preset {} saved", preset.name));
            },
            [&](const ui::LoadPreset& preset) {
                if (maySet()) loadPreset(controller, preset.name, notices);
            },
            [&](const ui::DeletePreset& preset) {
                if (succeeded(notices, controller.presets.remove(preset.name), "The preset was not deleted"))
                    confirm(notices, fmt::format("Preset {} deleted", preset.name));
            },
        },
        command);
}

void replaceView(SettingsController& controller, ViewSettings settings, std::string name) {
    controller.undo.add(controller.settings.view, settings, std::move(name));
    controller.settings.view = std::move(settings);
}

ui::SettingsView settingsViewOf(SettingsController& controller) {
    return {controller.presets.views(controller.settings.view), controller.undo.undoName(),
            controller.undo.redoName()};
}

}  // namespace worldy
