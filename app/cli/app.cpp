#include "app/cli/app.h"

#include <fmt/format.h>

#include <chrono>
#include <utility>

#include "app/base/exit_code.h"
#include "app/base/message.h"
#include "app/base/output_file.h"
#include "app/base/places.h"
#include "app/base/stopwatch.h"
#include "app/base/text.h"
#include "app/cli/shot_command.h"
#include "app/data/bake_progress.h"
#include "app/editor/editor.h"
#include "app/settings/screenshot.h"
#include "app/settings/session_file.h"
#include "app/settings/settings_text.h"
#include "app/trace/trace_document.h"
#include "app/window/window.h"
#include "planet/source/height_source.h"

namespace worldy {

namespace {

namespace fs = std::filesystem;
using planet::Result;

struct OpenSettings {
    Settings settings;
    fs::path file;
    std::string textBefore;  // of the settings as they were read or saved last
    bool mayBeSaved = true;  // false: the file could not be read and is not overwritten
};

// Reads the settings. A file named by the user must be valid; if the user's own is not, a warning is logged
// and defaults are used.
Result<OpenSettings> openSettings(const AppOptions& options, const Log& log) {
    OpenSettings open;
    const bool named = !options.settingsFile.empty();
    open.file = named ? options.settingsFile : configFolder() / "settings.toml";
    std::error_code status;
    if (named || fs::exists(open.file, status)) {
        Result<Settings> loaded = named ? loadSettingsOfAnyKind(open.file) : loadSettings(open.file);
        if (!loaded && named) return tl::unexpected(loaded.error());
        if (loaded)
            open.settings = *loaded;
        else
            log->warn("{}; using the defaults and leaving the file unchanged", loaded.error().message);
        // A screenshot provides settings but is never overwritten.
        open.mayBeSaved = loaded.has_value() && !isPng(open.file);
    }
    open.textBefore = settingsText(open.settings);
    return open;
}

void saveIfChanged(OpenSettings& open, const Settings& now, const Log& log) {
    const std::string text = settingsText(now);
    if (!open.mayBeSaved || text == open.textBefore) return;
    open.textBefore = text;
    if (const Result<void> saved = saveSettings(now, open.file); !saved)
        log->error("{}", saved.error().message);
}

Result<DataSet> chosenDataSet(const AppOptions& options, const Settings& settings) {
    // A trace is shown beside the planet that is shown without it.
    const bool isNamed = !options.file.empty() && !isTraceFile(options.file);
    const bool fromSettings = !isNamed && !settings.dataSet.empty();
    const fs::path named = isNamed ? options.file : fromSettings ? fs::path(settings.dataSet) : earthWorld();
    // The settings' own image is also the source of the colour tiles.
    const bool ownPicture = fromSettings && !settings.colourImage.empty();
    Result<DataSet> set =
        findDataSet(named, {}, {}, ownPicture ? std::optional(fs::path(settings.colourImage)) : std::nullopt);
    if (set && ownPicture) set->colourImage = settings.colourImage;
    return set;
}

// A data set with its source, which is open if it has to be baked. Opening it may read all of its samples.
struct CheckedData {
    DataSet set;
    std::optional<planet::HeightSource> source;
};

// Reports bad data before a window opens.
Result<CheckedData> checked(const DataSet& set) {
    if (set.needsBake) {
        return planet::openHeightSource(set.source, {}).map([&](const planet::HeightSource& source) {
            return CheckedData{set, source};
        });
    }
    return planet::ChunkFile::open(set.chunkFile).map([&](const auto&) { return CheckedData{set, {}}; });
}

// Returns the last session if the window is to go on with it, else an empty one.
LastSession sessionToResume(const AppOptions& options, const Settings& settings, const Log& log) {
    if (!options.file.empty() || !settings.dataSet.empty() || !settings.workspace.preferences.resume)
        return {};
    Result<LastSession> last = loadLastSession(lastSessionFile());
    if (last) return std::move(*last);
    log->warn("{}; the last session is not opened", last.error().message);
    return {};
}

// Returns the planet of the last session, or the one that the options ask for. A last session that cannot be opened is
// emptied.
Result<CheckedData> dataToShow(const AppOptions& options, const Settings& settings, LastSession& last,
                               const Log& log) {
    if (!last.file.empty()) {
        Result<CheckedData> again = findDataSet(last.file, {}, {}, std::nullopt).and_then(checked);
        if (again) return again;
        log->warn("{}; the planet of the last session is not opened", again.error().message);
        last = {};
    }
    return chosenDataSet(options, settings).and_then(checked);
}

// Keeps the settings and the session in their files, so that a crash loses little of them.
class StateKeeper {
public:
    explicit StateKeeper(OpenSettings open) : open_(std::move(open)) {}

    bool isDue() const {
        constexpr double intervalS = 30;
        return sinceKept_.elapsedS() > intervalS;
    }

    // session: lastSessionText(); empty: not known.
    void keep(const Settings& settings, const std::string& session, const Log& log) {
        sinceKept_ = {};
        saveIfChanged(open_, settings, log);
        if (!maySaveSession_ || session.empty() || session == session_) return;
        session_ = session;
        if (const Result<void> saved = writeTextFile(lastSessionFile(), session); !saved)
            log->error("{}", saved.error().message);
    }

private:
    OpenSettings open_;
    std::string session_;  // as it was written last
    // A file that could not be read is not overwritten.
    bool maySaveSession_ = loadLastSession(lastSessionFile()).has_value();
    Stopwatch sinceKept_;
};

int runWindow(Window& window, const AppOptions& options, CheckedData data, const OpenSettings& open,
              const LastSession& last, Log& log) {
    window.setTitle(fmt::format("{} - Worldy", sourceName(data.set.source)));
    log->info("{}", window.openGlText());
    Session session = startSession(std::move(data.set), options.shaderFolder, log, std::move(data.source));
    session.shaders.worker = window.makeShaderWorker();
    Editor editor(open.settings, log);
    editor.keepItemMap(options.itemMapFile);
    editor.resume(isTraceFile(options.file) ? LastSession{.trace = options.file} : last);
    StateKeeper keeper(open);
    const auto keep = [&] {
        Settings settings = editor.settings();
        settings.windowWidthPx = static_cast<int>(window.width());
        settings.windowHeightPx = static_cast<int>(window.height());
        keeper.keep(settings, shownScene(session) ? lastSessionText(editor.lastSession(session)) : "", log);
    };
    auto lastFrame = std::chrono::steady_clock::now();
    while (!window.closing()) {
        editor.rest(window, session);
        const auto now = std::chrono::steady_clock::now();
        editor.runFrame(window, session, std::chrono::duration<double>(now - lastFrame).count());
        lastFrame = now;
        if (keeper.isDue()) keep();
    }
    editor.endFlights(session);
    keep();
    if (shownScene(session)) return exitOk;
    if (session.bake) return exitCancelled;
    if (!session.problem) return exitOk;
    return session.problem->kind == planet::ErrorKind::Cancelled ? exitCancelled : exitBadInput;
}

Result<void> bakeIfNeeded(const CheckedData& data) {
    if (!data.source) return {};
    std::error_code status;
    fs::create_directories(data.set.chunkFile.parent_path(), status);
    return bakeOnTerminal(*data.source, data.set.settings, data.set.chunkFile,
                          JobColour{data.set.bakedColour, true})
        .map([](const auto&) {});
}

// Writes the first view that the window would show. The file is beside the bakes, because Worldy overwrites
// it every time and the current folder may be a source tree.
Result<void> writeFirstView(const AppOptions& options, const CheckedData& data, const Settings& settings) {
    if (Result<void> baked = bakeIfNeeded(data); !baked) return baked;
    ShotOptions shot;
    shot.file = data.set.chunkFile;
    shot.output = cacheFolder() / "worldy-first-view.png";
    std::error_code status;
    fs::create_directories(shot.output.parent_path(), status);
    shot.shaderFolder = options.shaderFolder;
    shot.colourImage = data.set.colourImage;
    shot.size = {settings.windowWidthPx, settings.windowHeightPx};
    shot.view = settings.view;
    if (settings.camera.altitudeM != 0) shot.camera = settings.camera;
    return takeShot(shot);
}

}  // namespace

int runApp(const AppOptions& options) {
    Log log;
    const Result<OpenSettings> open = openSettings(options, log);
    if (!open) return reportError(open.error());
    LastSession last = sessionToResume(options, open->settings, log);
    const Result<CheckedData> data = dataToShow(options, open->settings, last, log);
    if (!data) return reportError(data.error());

    std::error_code status;
    fs::create_directories(configFolder(), status);
    auto window = Window::open({open->settings.windowWidthPx, open->settings.windowHeightPx,
                                configFolder() / "imgui.ini", open->settings.workspace.preferences.theme,
                                open->settings.workspace.preferences.scale});
    if (window) return runWindow(*window, options, *data, *open, last, log);
    if (window.error().problem == WindowProblem::NoOpenGl) {
        return reportError({planet::ErrorKind::BadInput, window.error().message});
    }
    printMessage("worldy: no display ({}); writing a picture of the first view instead\n",
                 window.error().message);
    const Result<void> written = writeFirstView(options, *data, open->settings);
    return written ? exitOk : reportError(written.error());
}

}  // namespace worldy
