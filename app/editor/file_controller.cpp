#include "app/editor/file_controller.h"

#include <fmt/format.h>

#include <utility>

#include "app/data/recent_files.h"
#include "app/flight/flight_record.h"
#include "app/session/overloaded.h"
#include "app/settings/region_file.h"
#include "app/settings/screenshot.h"
#include "app/settings/settings_text.h"
#include "app/trace/trace_document.h"
#include "planet/measure/atlas_file.h"
#include "planet/source/terrain.h"

namespace worldy {

namespace {

using planet::Result;

std::string undoNameOf(const std::filesystem::path& file) {
    return "settings of " + file.filename().string();
}

void openPreset(const std::filesystem::path& file, const FileContext& context, Notices& notices) {
    if (!mayChange("Settings", context.replaying, notices.log)) return;
    Result<ViewSettings> loaded = loadViewSettings(file, context.settings.settings.view);
    if (!loaded) return tellCannotOpen(notices, file, loaded.error());
    replaceView(context.settings, std::move(*loaded), undoNameOf(file));
    confirm(notices, fmt::format("Settings of {} loaded", file.string()));
}

// Returns false if the picture contains no settings and so is no screenshot.
bool openScreenshot(const std::filesystem::path& file, const FileContext& context, Notices& notices) {
    const Result<ScreenshotNote> note = readScreenshotNote(file);
    if (!note) return false;
    if (!mayChange("Settings", context.replaying, notices.log)) return true;
    Settings& settings = context.settings.settings;
    Result<Settings> loaded = settingsFromText(note->settings, file, settings);
    if (!loaded) {
        tellCannotOpen(notices, file, loaded.error());
        return true;
    }
    replaceView(context.settings, std::move(loaded->view), undoNameOf(file));
    if (const Scene* scene = shownScene(std::as_const(context.session)))
        moveCamera(context.camera, cameraFromPose(note->camera, scene->planet->tree().shape.radiusM),
                   settings.view.camera);
    confirm(notices, fmt::format("Camera and settings of {} loaded", file.string()));
    return true;
}

void keepRecent(FileController& files, Notices& notices) {
    files.recentShown = shownRecentFiles(files.recent);
    succeeded(notices, saveRecentFiles(files.recent, recentFilesFile()),
              "The list of recent files was not saved");
}

void open(FileController& files, const std::filesystem::path& file, const FileContext& context,
          Notices& notices, ui::Commands& next) {
    if (!planet::isTerrainText(file)) {
        if (isRegionsFile(file)) return next.push_back(ui::LoadRegions{file});
        if (file.extension() == ".toml" && !planet::isWorldFile(file))
            return openPreset(file, context, notices);
        if (isFlightRecord(file)) return next.push_back(ui::StartReplay{file});
        const bool isTrace = isTraceFile(file);
        if (isTrace) {
            addRecentFile(files.recent, file);
            keepRecent(files, notices);
        }
        if (planet::isNamedAtlas(file)) return next.push_back(ui::OpenAtlas{file});
        // A file that is only named like a trace gets the error of one.
        if (isTrace || file.extension() == ".lodtrace") return next.push_back(ui::OpenTrace{file});
        if (file.extension() == ".png" && openScreenshot(file, context, notices)) return;
    }
    if (!openFile(context.session, file, context.settings.settings.view, notices.log)) {
        showError(notices, openingFailed(file, *context.session.problem));  // already logged
        return;
    }
    files.opening = file;  // its bake may still fail
}

}  // namespace

FileController openFileController() {
    FileController files;
    files.recent = loadRecentFiles(recentFilesFile());
    files.recentShown = shownRecentFiles(files.recent);
    return files;
}

void execute(FileController& files, const ui::FileCommand& command, const FileContext& context,
             Notices& notices, ui::Commands& next) {
    std::visit(Overloaded{
                   [&](const ui::OpenFile& file) { open(files, file.file, context, notices, next); },
                   [&](const ui::AskForFile& asked) {
                       files.dialog.opening = true;
                       files.dialog.purpose = asked.purpose;
                   },
               },
               command);
}

bool followOpening(FileController& files, const Session& session, Notices& notices) {
    if (!files.opening || session.bake) return false;
    const std::filesystem::path file = *std::exchange(files.opening, std::nullopt);
    if (!session.problem) {
        addRecentFile(files.recent, file);
        files.recentShown = shownRecentFiles(files.recent);
        return true;
    }
    if (session.open && session.problem->kind != planet::ErrorKind::Cancelled)
        showError(notices,
                  {fmt::format("{} cannot be baked", file.filename().string()), session.problem->message,
                   "The open planet is kept. Fix the file or open another one.", true});
    return false;
}

void advanceFiles(FileController& files, const Session& session, Notices& notices) {
    if (followOpening(files, session, notices)) keepRecent(files, notices);
}

}  // namespace worldy
