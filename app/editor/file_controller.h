// Opens files of all kinds, keeps the list of recent ones, and holds the open trace. Main thread.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "app/editor/camera_controller.h"
#include "app/editor/notes_controller.h"
#include "app/editor/settings_controller.h"
#include "app/editor/trace_controller.h"
#include "app/session/notices.h"
#include "app/session/session.h"
#include "app/settings/session_file.h"
#include "ui/model/commands.h"
#include "ui/shell/open_dialog.h"

namespace worldy {

struct FileController {
    std::optional<std::filesystem::path> opening;    // requested, but not known to be open yet
    std::vector<std::filesystem::path> recent;       // as stored
    std::vector<std::filesystem::path> recentShown;  // those that exist
    ui::OpenDialogState dialog;
    LastSession atStart{};    // what the first frames open; its planet is open or will be
    TraceController trace{};  // the open trace, beside the planet
    NotesController notes{};  // the notes on the shown planet
};

FileController openFileController();

// Parts of other features that opening a file may change.
struct FileContext {
    Session& session;
    SettingsController& settings;
    CameraController& camera;
    bool replaying = false;  // settings then stay as they are
};
// next: receives the command that replays a recorded flight if one is opened.
void execute(FileController& files, const ui::FileCommand& command, const FileContext& context,
             Notices& notices, ui::Commands& next);

// Call every frame. Once the requested file is open, possibly after a bake, makes it the first recent one and
// returns true. If its bake failed, shows a message box, unless the bake was cancelled or no planet is shown,
// in which case the viewport reports the failure.
bool followOpening(FileController& files, const Session& session, Notices& notices);
// Does the same and saves the list of recent files.
void advanceFiles(FileController& files, const Session& session, Notices& notices);

}  // namespace worldy
