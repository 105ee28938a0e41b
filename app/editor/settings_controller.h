// The settings, their undo history and the presets. Main thread.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "app/data/data_set.h"
#include "app/data/layout_library.h"
#include "app/editor/frame_controller.h"
#include "app/scene/governing.h"
#include "app/session/notices.h"
#include "app/session/presets.h"
#include "app/settings/region_files.h"
#include "app/settings/settings.h"
#include "app/settings/undo.h"
#include "planet/planet.h"
#include "ui/model/commands.h"
#include "ui/model/editor_view.h"

namespace worldy {

struct SettingsController {
    Settings settings;
    std::filesystem::path file{};  // what the settings are saved in, empty if they are not
    UndoHistory undo;
    PresetLibrary presets{presetFolders()};
    LayoutLibrary layouts{layoutFolders()};
    std::optional<Workspace> unsavedLayout;  // the last one that another replaced before it was saved
    RegionFiles regions{};
    Governing governing;  // moves τ of the settings while a budget is on
};

// Moves τ by the budgets, unless the next frame will not step. secondsSinceLast: >= 0.
void governFrame(SettingsController& controller, const FrameController& frames, const planet::Planet& planet,
                 double secondsSinceLast);
// Returns view settings with the user's own τ, which a budget replaces while it is on.
ViewSettings ungoverned(const SettingsController& controller, ViewSettings view);

// Settings stay as they are during a replay, which restores them at its end.
void execute(SettingsController& controller, const ui::SettingsCommand& command, bool replaying,
             Notices& notices);

// Call in every frame in which a planet is shown. For another one than before, reads the regions beside it, or takes those
// that were not saved when it was shown last. Those that the settings of the first planet name stay. files: the source, and
// its bake.
void followRegions(SettingsController& controller, const DataSet& files, Notices& notices);

// Returns whether the window may close. If regions are not saved, the user is asked first, or they are saved; during a replay,
// the regions are those from before it.
bool mayQuit(SettingsController& controller, const ui::Quit& quit, bool replaying, Notices& notices);

// Replaces the view settings as one undo step. name: as the undo menu shows it, "preset popping".
void replaceView(SettingsController& controller, ViewSettings settings, std::string name);

// Valid until the presets change.
ui::SettingsView settingsViewOf(SettingsController& controller);

}  // namespace worldy
