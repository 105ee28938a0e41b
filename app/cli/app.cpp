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
#include "app/settings/region_file.h"
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
    std::string problem{};   // why the defaults are used instead, a sentence; empty: they are not
};

// Reads the settings. A file named by the user must be valid; if the user's own is not, defaults are used.
Result<OpenSettings> openSettings(const AppOptions& options) {
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
            open.problem =
                fmt::format("{}; using the defaults and leaving the file unchanged.", loaded.error().message);
        // A screenshot provides settings but is never overwritten.
        open.mayBeSaved = loaded.has_value() && !isPng(open.file);
    }
    open.textBefore = settingsText(open.settings);
    return open;
}

Result<void> saveIfChanged(OpenSettings& open, const Settings& now) {
    const std::string text = settingsText(now);
    if (!open.mayBeSaved || text == open.textBefore) return {};
    open.textBefore = text;
    return saveSettings(now, open.file);
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
        return planet::openHeightSource(set.source, set.sourceSettings)
            .map([&](const planet::HeightSource& source) {
                return CheckedData{set, source};
            });
    }
    return planet::ChunkFile::open(set.chunkFile).map([&](const auto&) { return CheckedData{set, {}}; });
}

// The session that a start goes on with.
struct Resumed {
    LastSession session;
    KeptResults results;
    std::string problem;      // why it or a part of it is not opened, sentences; empty: it is
    bool isUnopened = false;  // its planet cannot be opened, so that another one is shown

    void add(const std::string& sentence) { problem += (problem.empty() ? "" : "\n") + sentence; }
};

// Returns the last session if the window is to go on with it, else an empty one.
Resumed sessionToResume(const AppOptions& options, const Settings& settings) {
    Resumed resumed;
    if (!options.file.empty() || !settings.dataSet.empty() || !settings.workspace.preferences.resume)
        return resumed;
    Result<LastSession> last = loadLastSession(lastSessionFile());
    if (!last) {
        resumed.add(fmt::format("{}; the last session is not opened.", last.error().message));
        return resumed;
    }
    resumed.session = std::move(*last);
    Result<KeptResults> results = loadKeptResults(keptResultsFile());
    if (results)
        resumed.results = std::move(*results);
    else
        resumed.add(
            fmt::format("{}; the results of the last session are not shown.", results.error().message));
    return resumed;
}

// Returns why a bake of a source cannot be shown for it; empty if it can.
std::string whyNotBake(const fs::path& source, const fs::path& bake) {
    if (const auto file = planet::ChunkFile::open(bake); !file) return file.error().message;
    std::error_code noSource, noBake;
    const fs::file_time_type changed = fs::last_write_time(source, noSource);
    const fs::file_time_type baked = fs::last_write_time(bake, noBake);
    const bool isOlder = !noSource && !noBake && baked < changed;
    return isOlder ? fmt::format("{} is newer than {}", source.string(), bake.string()) : std::string();
}

// Finds the data set of the last session with the bake that was shown.
Result<DataSet> dataSetOf(Resumed& resumed) {
    const LastSession& last = resumed.session;
    Result<DataSet> set = findDataSet(last.file, {}, last.sourceSettings, last.colour);
    if (!set || last.bake.empty() || last.bake == set->chunkFile) return set;
    if (const std::string whyNot = whyNotBake(last.file, last.bake); !whyNot.empty()) {
        resumed.add(
            fmt::format("{}; {} is shown with its default bake settings.", whyNot, sourceName(last.file)));
        return set;
    }
    set->chunkFile = last.bake;
    set->needsBake = false;
    return set;
}

// Returns the planet of the last session, or the one that the options ask for. A last session that cannot be opened is
// emptied.
Result<CheckedData> dataToShow(const AppOptions& options, const Settings& settings, Resumed& resumed) {
    if (!resumed.session.file.empty()) {
        Result<CheckedData> again = dataSetOf(resumed).and_then(checked);
        if (again) return again;
        resumed = {};
        resumed.isUnopened = true;
        resumed.add(
            fmt::format("{}; the planet of the last session is not opened. The next start tries it "
                        "again, unless you open another file.",
                        again.error().message));
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

    // session, results: lastSessionText(), keptResultsText(); empty: not known. Returns the first Error of writing.
    Result<void> keep(const Settings& settings, const std::string& session, const std::string& results) {
        sinceKept_ = {};
        Result<void> kept = saveIfChanged(open_, settings);
        for (const Result<void>& one : {keepText(session_, session), keepText(results_, results)})
            if (kept && !one) kept = one;
        return kept;
    }

private:
    struct KeptText {
        fs::path file;
        bool mayBeWritten;   // a file that could not be read is not overwritten
        std::string text{};  // as it was written last
    };
    static Result<void> keepText(KeptText& kept, const std::string& text) {
        if (!kept.mayBeWritten || text.empty() || text == kept.text) return {};
        kept.text = text;
        return writeTextFile(kept.file, text);
    }

    OpenSettings open_;
    KeptText session_{lastSessionFile(), loadLastSession(lastSessionFile()).has_value()};
    KeptText results_{keptResultsFile(), loadKeptResults(keptResultsFile()).has_value()};
    Stopwatch sinceKept_;
};

int runWindow(Window& window, const AppOptions& options, CheckedData data, const OpenSettings& open,
              const Resumed& resumed, Log& log) {
    window.setTitle(fmt::format("{} - Worldy", sourceName(data.set.source)));
    log.info("{}", window.openGlText());
    Session session = startSession(std::move(data.set), options.shaderFolder, log, std::move(data.source));
    session.shaders.worker = window.makeShaderWorker();
    Editor editor(open.settings, open.mayBeSaved ? open.file : fs::path{}, log);
    editor.keepItemMap(options.itemMapFile);
    if (isTraceFile(options.file))
        editor.resume({.trace = options.file}, {}, {});
    else
        editor.resume(resumed.session, resumed.results, resumed.problem);
    // A planet that only stands in for that of the last session does not replace it.
    const fs::path standIn = resumed.isUnopened ? session.data.source : fs::path{};
    StateKeeper keeper(open);
    bool isFailureTold = false;
    const auto keep = [&] {
        Settings settings = editor.settings();
        settings.windowWidthPx = static_cast<int>(window.width());
        settings.windowHeightPx = static_cast<int>(window.height());
        const bool isShown = shownScene(session) && (standIn.empty() || session.data.source != standIn);
        const std::optional<KeptResults> results = editor.keptResults();
        const Result<void> kept =
            keeper.keep(settings, isShown ? lastSessionText(editor.lastSession(session)) : "",
                        isShown && results ? keptResultsText(*results) : "");
        if (kept) return;
        // A full disk is told once, not every half minute.
        if (std::exchange(isFailureTold, true))
            log.error("{}", kept.error().message);
        else
            editor.tell("The settings and the session were not saved", kept.error().message);
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
    Result<OpenSettings> open = openSettings(options);
    if (!open) return reportError(open.error());
    // The editor reads those beside the planet.
    if (!options.regionsFile.empty()) {
        Result<RegionSettings> regions = regionsFor(options.regionsFile, {});
        if (!regions) return reportError(regions.error());
        regions->on = open->settings.view.regions.on;
        open->settings.view.regions = std::move(*regions);
    }
    Resumed resumed = sessionToResume(options, open->settings);
    if (!open->problem.empty()) resumed.add(open->problem);
    const Result<CheckedData> data = dataToShow(options, open->settings, resumed);
    if (!data) return reportError(data.error());

    std::error_code status;
    fs::create_directories(configFolder(), status);
    auto window = Window::open({open->settings.windowWidthPx, open->settings.windowHeightPx,
                                configFolder() / "imgui.ini", open->settings.workspace.preferences.theme,
                                open->settings.workspace.preferences.scale});
    if (window) return runWindow(*window, options, *data, *open, resumed, log);
    if (window.error().problem == WindowProblem::NoOpenGl) {
        return reportError({planet::ErrorKind::BadInput, window.error().message});
    }
    if (!resumed.problem.empty()) log.warn("{}", resumed.problem);
    printMessage("worldy: no display ({}); writing a picture of the first view instead\n",
                 window.error().message);
    const Result<void> written = writeFirstView(options, *data, open->settings);
    return written ? exitOk : reportError(written.error());
}

}  // namespace worldy
