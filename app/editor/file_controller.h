// Opening of files, whatever they hold, and the list of recent ones. Main thread.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "app/editor/camera_controller.h"
#include "app/editor/notices.h"
#include "app/editor/session.h"
#include "app/editor/settings_controller.h"
#include "ui/model/commands.h"
#include "ui/shell/open_dialog.h"

namespace worldy {

struct FileController {
    std::optional<std::filesystem::path> opening;    // asked for, and not known to be open yet
    std::vector<std::filesystem::path> recent;       // as kept
    std::vector<std::filesystem::path> recentShown;  // those that exist
    ui::OpenDialogState dialog;
};

FileController openFileController();

// The parts of other features that opening a file may change.
struct FileContext {
    Session& session;
    SettingsController& settings;
    CameraController& camera;
    bool replaying = false;  // then settings stay as they are
};
// next: where opening a recorded flight adds the command that replays it.
void execute(FileController& files, const ui::FileCommand& command, const FileContext& context,
             Notices& notices, ui::Commands& next);

// Once a file that was asked for is open, maybe baked first: makes it the first of the recent ones and
// returns true. If its bake has failed, reports it in a message box, unless it was cancelled or the viewport,
// having no planet, reports it itself.
bool followOpening(FileController& files, const Session& session, Notices& notices);
// Does the same and saves the list of recent files.
void advanceFiles(FileController& files, const Session& session, Notices& notices);

}  // namespace worldy
