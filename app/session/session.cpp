#include "app/session/session.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "app/base/text.h"
#include "app/data/bake_progress.h"
#include "planet/source/terrain.h"

namespace worldy {

namespace {

namespace fs = std::filesystem;
using planet::Result;
using planet::gl::ChunkPrograms;

// Returns the bake settings stored in a file, which exclude the compression level and the source's path.
BakeRequest requestOf(const planet::PlanetShape& shape) {
    BakeRequest request;
    request.settings.faceSize = planet::faceCells(shape) + 1;
    request.settings.chunkSize = planet::chunkSize(shape);
    request.settings.radiusM = shape.radiusM;
    request.settings.quantumM = fileQuantumM(shape);
    if (shape.fractionBits > 0) request.settings.finestQuantumM = shape.quantumM;
    return request;
}

// Adds the file's own colour tiles to the request.
void addColours(const planet::ChunkFileInfo& info, const DataSet& data, BakeRequest& request) {
    if (!info.colour) return;
    request.settings.colour.format = info.colour->format;
    request.settings.colour.faceSize = (planet::colourTileCells << info.colour->leafLevel) + 1;
    request.colour = data.bakedColour;
}

// Returns a planet that was just opened with what is known of it.
OpenPlanet openedAs(const DataSet& data, Scene&& scene) {
    // The stored shape is used, because the planet's own shape includes the exaggeration.
    const planet::PlanetShape shape = scene.planet->file().info().shape;
    OpenPlanet open{data, requestOf(shape), false, false, std::move(scene)};
    open.scene.renderer.chunks().setAirInBackground(true);
    open.baked.source =
        data.source != data.chunkFile ? data.source : sourceOf(open.scene.planet->file().info());
    open.baked.sourceSettings = data.sourceSettings;
    open.sourceIsThere = planet::heightSourceExists(open.baked.source);
    addColours(open.scene.planet->file().info(), data, open.baked);
    return open;
}

Result<OpenPlanet> openPlanet(Session& session, const DataSet& data, const ViewSettings& settings,
                              const Log& log) {
    if (!session.shaders.programs) {
        Result<ChunkPrograms> programs = ChunkPrograms::build(session.shaders.folder, session.shaders.worker);
        if (!programs) return tl::unexpected(programs.error());
        session.shaders.programs = std::make_shared<ChunkPrograms>(std::move(*programs));
    }
    Result<Scene> scene = openScene(
        {data.chunkFile, session.shaders.folder, data.colourImage, session.shaders.programs}, settings);
    if (!scene) return tl::unexpected(scene.error());
    OpenPlanet open = openedAs(data, std::move(*scene));
    const planet::ChunkFile& file = open.scene.planet->file();
    log.info("Open: {}, {} on disk, {} levels", data.chunkFile.string(),
             bytesText(static_cast<double>(file.sizeBytes())), planet::deepestLevelOf(file.info().shape) + 1);
    log.debug("Depth buffer: {}", open.scene.renderer.chunks().capabilities().reversedZ
                                      ? "float, reversed Z"
                                      : "non-reversed, near plane follows the ground");
    return open;
}

void show(Session& session, OpenPlanet&& open, bool keepOld) {
    session.showsPrevious = false;
    session.previous.reset();
    if (keepOld && session.open) session.previous.emplace(std::move(*session.open));
    session.data = open.data;
    session.data.needsBake = false;
    session.open.emplace(std::move(open));
    session.problem.reset();
}

void fail(Session& session, const planet::Error& error, const Log& log) {
    log.error("{}", error.message);
    session.problem = error;
}

// Cancels the bake without waiting for it; it is freed when it has ended.
void retireBake(Session& session, const Log& log) {
    if (!session.bake) return;
    if (!session.bake->stopping())
        log.warn("The bake of {} was cancelled", session.bake->data.source.string());
    if (session.bake->job) {
        session.bake->job->cancel();
        session.ending.push_back(std::move(session.bake->job));
    }
    session.bake.reset();
}

void beginBake(Session& session, SessionBake&& bake, const Log& log) {
    log.info("Baking {} into {}", bake.data.source.string(), bake.data.chunkFile.string());
    session.bakeProblem.reset();
    session.bake.emplace(std::move(bake));
}

// Returns the bake to copy unchanged chunks from: that of the same source which is open, or else one in the cache.
fs::path earlierBakeFor(const Session& session, const SessionBake& bake) {
    const bool isOpen = session.open && !session.open->isFirstLook &&
                        session.open->baked.source == bake.data.source &&
                        session.open->baked.settings.chunkSize == bake.request.settings.chunkSize;
    if (isOpen) return session.open->data.chunkFile;
    return earlierBakeOf(bake.data.source, bake.request.settings);
}

// Starts the bake once cancelled bakes have ended, because two bakes must not write the same file.
void launchWaitingBake(Session& session) {
    std::erase_if(session.ending, [](const auto& job) { return job->takeResult().has_value(); });
    if (!session.bake || session.bake->job || !session.ending.empty()) return;
    SessionBake& bake = *session.bake;
    planet::BakeSettings settings = bake.request.settings;
    settings.reuse = earlierBakeFor(session, bake);
    std::error_code status;
    fs::create_directories(bake.data.chunkFile.parent_path(), status);
    std::optional<FirstLook> firstLook;
    if (bake.needed) {
        bake.firstLook = firstLookOf(bake.data);
        if (bake.firstLook->needsBake)
            firstLook = {.settings = bake.firstLook->settings, .output = bake.firstLook->chunkFile};
    }
    bake.job =
        std::make_unique<BakeJob>(BakeTask{.source = bake.data.source,
                                           .sourceSettings = bake.request.sourceSettings,
                                           .settings = settings,
                                           .output = bake.data.chunkFile,
                                           .colour = JobColour{bake.data.bakedColour, bake.colourMayFail},
                                           .firstLook = firstLook,
                                           .opened = std::exchange(bake.opened, std::nullopt),
                                           .launcher = bake.request.launcher});
}

// Shows the coarse bake of a planet as soon as it is there. The whole bake goes on, and then takes its place.
void showFirstLook(Session& session, const ViewSettings& settings, const Log& log) {
    if (!session.bake || !session.bake->job || !session.bake->firstLook) return;
    SessionBake& bake = *session.bake;
    if (bake.job->takeFirstLook()) bake.firstLook->needsBake = false;
    if (bake.firstLook->needsBake) return;
    const DataSet look = *std::exchange(bake.firstLook, std::nullopt);
    Result<OpenPlanet> open = openPlanet(session, look, settings, log);
    if (!open) {
        log.warn("{}; waiting for the whole bake", open.error().message);
        return;
    }
    log.info("This is a coarse first look. The whole bake takes its place when it is done.");
    open->layers = bake.job->layers();
    open->isFirstLook = true;
    show(session, std::move(*open), false);
    bake.needed = false;
    bake.forComparison = false;
}

void failBake(Session& session, const SessionBake& bake, const planet::Error& error, const Log& log) {
    const bool cancelled = error.kind == planet::ErrorKind::Cancelled;
    log.write(cancelled ? LogLevel::Warning : LogLevel::Error,
              cancelled ? "The bake was cancelled" : error.message);
    session.bakeProblem = error;
    if (bake.needed) session.problem = error;
}

void finishBake(Session& session, const ViewSettings& settings, const Log& log) {
    if (!session.bake || !session.bake->job) return;
    const std::optional<Result<planet::BakeReport>> result = session.bake->job->takeResult();
    if (!result) return;
    SessionBake bake = std::move(*session.bake);
    session.bake.reset();
    if (!*result) return failBake(session, bake, result->error(), log);
    const planet::BakeReport& report = **result;
    log.info("Baked: {} samples in {}, {}", countText(static_cast<double>(report.samples)),
             durationText(report.seconds), bytesText(static_cast<double>(report.fileBytes)));
    if (report.copiedChunks > 0) log.info("{} from an earlier bake", copiedText(report));
    if (!report.reuseNotice.empty())
        log.write(report.reuseIsDamaged ? LogLevel::Warning : LogLevel::Debug, reuseText(report));
    session.bakeReport = report;
    const std::string colourProblem = bake.job->colourProblem();
    if (!colourProblem.empty()) log.warn("{}; baked without colours", colourProblem);
    if (!report.colourNotice.empty()) log.warn("{}", report.colourNotice);
    if (!report.quantumNotice.empty()) log.warn("{}", report.quantumNotice);
    bake.data.needsBake = false;
    Result<OpenPlanet> open = openPlanet(session, bake.data, settings, log);
    if (!open) return failBake(session, bake, open.error(), log);
    open->baked = bake.request;
    open->baked.settings.faceSize = planet::faceCells(report.shape) + 1;
    open->baked.settings.quantumM = fileQuantumM(report.shape);
    open->baked.settings.finestQuantumM.reset();
    if (report.shape.fractionBits > 0) open->baked.settings.finestQuantumM = report.shape.quantumM;
    open->baked.colour.clear();
    addColours(open->scene.planet->file().info(), open->data, open->baked);
    open->compressionKnown = true;
    open->layers = bake.job->layers();
    open->sourceIsThere = planet::heightSourceExists(bake.request.source);
    show(session, std::move(*open), bake.forComparison);
}

void tellProblems(std::optional<OpenPlanet>& open, const Log& log) {
    if (!open) return;
    for (const std::string& problem : takeProblems(open->scene)) log.error("{}", problem);
}

fs::file_time_type newestIn(const fs::path& folder) {
    fs::file_time_type newest = fs::file_time_type::min();  // current times are negative on some clocks
    std::error_code status;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, status)) {
        newest = std::max(newest, entry.last_write_time(status));
    }
    return newest;
}

std::string messageOf(const planet::Error& error) {
    return error.kind == planet::ErrorKind::Cancelled ? "The bake was cancelled." : error.message;
}

std::string summaryOf(const OpenPlanet& open) {
    const planet::ChunkFile& file = open.scene.planet->file();
    return fmt::format("{} vertices, {} samples, {}", planet::chunkSize(file.info().shape),
                       planet::faceCells(file.info().shape) + 1,
                       bytesText(static_cast<double>(file.sizeBytes())));
}

planet::Error missingSource(const fs::path& source) {
    if (planet::isTerrainText(source)) {
        if (const auto good = planet::terrainFromText(source); !good) return good.error();
    }
    return {planet::ErrorKind::BadInput,
            fmt::format("{}: no such source; expected an elevation image or raster, a world file, one "
                        "of six cube faces or terrain such as noise:ridged",
                        source.string())};
}

planet::Error missingColour(const fs::path& image) {
    return {
        planet::ErrorKind::BadInput,
        fmt::format("{}: no such colour image; expected an equirectangular image or one of six cube faces",
                    image.string())};
}

// Returns the data set that a request would create, or an Error if one of its sources is missing.
Result<DataSet> dataSetOf(const BakeRequest& request) {
    if (!planet::heightSourceExists(request.source)) return tl::unexpected(missingSource(request.source));
    if (!request.colour.empty() && !planet::heightSourceExists(request.colour))
        return tl::unexpected(missingColour(request.colour));
    return findDataSet(request.source, request.settings, request.sourceSettings, request.colour);
}

bool samePlace(const fs::path& a, const fs::path& b) {
    std::error_code status;
    return fs::absolute(a, status).lexically_normal() == fs::absolute(b, status).lexically_normal();
}

}  // namespace

Session startSession(DataSet data, const fs::path& shaderFolder, const Log& log,
                     std::optional<planet::HeightSource> opened) {
    Session session;
    session.data = std::move(data);
    session.shaders.folder = shaderFolder;
    if (!shaderFolder.empty()) session.shaders.changed = newestIn(shaderFolder);
    if (session.data.needsBake) startBake(session, log);
    if (session.bake) session.bake->opened = std::move(opened);
    return session;
}

bool openFile(Session& session, const fs::path& file, const ViewSettings& settings, const Log& log) {
    const Result<DataSet> data = findDataSet(file, {});
    if (!data) {
        fail(session, data.error(), log);
        return false;
    }
    if (data->needsBake) {
        const bool underWay = session.bake && !session.bake->stopping() &&
                              samePlace(session.bake->data.chunkFile, data->chunkFile);
        if (underWay) return true;
        retireBake(session, log);
        SessionBake bake;
        bake.request.source = data->source;
        bake.request.settings = data->settings;
        bake.request.colour = data->bakedColour;
        bake.colourMayFail = true;
        bake.data = *data;
        bake.needed = true;
        session.problem.reset();
        if (!session.open) session.data = *data;
        beginBake(session, std::move(bake), log);
        return true;
    }
    Result<OpenPlanet> open = openPlanet(session, *data, settings, log);
    if (!open) {
        fail(session, open.error(), log);
        return false;
    }
    retireBake(session, log);
    show(session, std::move(*open), false);
    return true;
}

void startBake(Session& session, const BakeRequest& request, const Log& log) {
    if (session.bake && !session.bake->stopping()) {
        log.warn("A bake is already running; cancel it or wait until it ends");
        return;
    }
    const Result<DataSet> found = dataSetOf(request);
    if (!found) {
        log.error("{}", found.error().message);
        session.bakeProblem = found.error();
        return;
    }
    retireBake(session, log);
    SessionBake bake;
    bake.request = request;
    bake.data = *found;
    // The image that was chosen for this source is kept.
    if (samePlace(session.data.source, request.source)) bake.data.colourImage = session.data.colourImage;
    bake.forComparison = true;
    bake.needed = !session.open;
    if (bake.needed) session.problem.reset();
    beginBake(session, std::move(bake), log);
}

void startBake(Session& session, const Log& log) {
    BakeRequest request;
    request.source = session.data.source;
    request.sourceSettings = session.data.sourceSettings;
    request.settings = session.data.settings;
    request.colour = session.data.bakedColour;
    startBake(session, request, log);
    if (session.bake) session.bake->colourMayFail = true;
}

void openBake(Session& session, const BakeRequest& request, const fs::path& chunkFile,
              const ViewSettings& settings, const Log& log) {
    if (session.bake && !session.bake->stopping()) {
        log.warn("A bake is running; cancel it or wait until it ends");
        return;
    }
    DataSet data = session.data;
    data.chunkFile = chunkFile;
    if (!request.source.empty()) {
        data.source = request.source;
        data.sourceSettings = request.sourceSettings;
    }
    Result<OpenPlanet> open = openPlanet(session, data, settings, log);
    if (!open && planet::heightSourceExists(request.source)) return startBake(session, request, log);
    if (!open) {
        log.error("{}", open.error().message);
        session.bakeProblem = open.error();
        return;
    }
    if (!request.source.empty()) {
        open->baked.source = request.source;
        open->sourceIsThere = planet::heightSourceExists(request.source);
    }
    show(session, std::move(*open), true);
}

void cancelBake(Session& session) {
    if (!session.bake) return;
    if (session.bake->job) return session.bake->job->cancel();
    session.bakeProblem = planet::cancelled().value();
    if (session.bake->needed) session.problem = session.bakeProblem;
    session.bake.reset();
}

void advanceSession(Session& session, const ViewSettings& settings, const Log& log) {
    finishBake(session, settings, log);
    launchWaitingBake(session);
    showFirstLook(session, settings, log);
    if (!session.open && !session.bake && !session.problem) {
        Result<OpenPlanet> open = openPlanet(session, session.data, settings, log);
        if (open)
            show(session, std::move(*open), false);
        else
            fail(session, open.error(), log);
    }
    tellProblems(session.open, log);
    tellProblems(session.previous, log);
}

void showPreviousBake(Session& session, bool shown) {
    session.showsPrevious = shown && session.previous;
}

void dismissPreviousBake(Session& session) {
    session.showsPrevious = false;
    session.previous.reset();
}

Result<OpenPlanet> openBeside(const Session& session, const DataSet& data, const ViewSettings& settings) {
    if (data.needsBake) {
        return planet::badInput(
            fmt::format("{}: is not baked yet; open it once in the window", data.source.string()));
    }
    Result<Scene> scene = openScene(
        {data.chunkFile, session.shaders.folder, data.colourImage, session.shaders.programs}, settings);
    if (!scene) return tl::unexpected(scene.error());
    return openedAs(data, std::move(*scene));
}

Result<OpenPlanet> openBeside(const Session& session, const fs::path& file, const ViewSettings& settings) {
    const Result<DataSet> data = findDataSet(file, {});
    if (!data) return tl::unexpected(data.error());
    return openBeside(session, *data, settings);
}

void exchangeShown(Session& session, OpenPlanet& other) {
    std::swap(session.showsPrevious ? *session.previous : *session.open, other);
    if (!session.showsPrevious) session.data = shownPlanet(session)->data;
}

namespace {

// Returns the shown planet, const if the session is.
template <class AnySession>
auto* shownIn(AnySession& session) {
    if (session.showsPrevious && session.previous) return &*session.previous;
    return session.open ? &*session.open : nullptr;
}

}  // namespace

const OpenPlanet* shownPlanet(const Session& session) {
    return shownIn(session);
}

Scene* shownScene(Session& session) {
    auto* open = shownIn(session);
    return open ? &open->scene : nullptr;
}

const Scene* shownScene(const Session& session) {
    const OpenPlanet* open = shownPlanet(session);
    return open ? &open->scene : nullptr;
}

ui::BakeView bakeViewOf(const Session& session) {
    ui::BakeView view;
    if (const OpenPlanet* open = shownPlanet(session)) {
        view.current = open->baked;
        view.compressionKnown = open->compressionKnown;
        view.canBake = open->sourceIsThere;
        const std::optional<planet::ColourPyramid>& colour = open->scene.planet->colour();
        if (colour && open->baked.colour.empty()) view.lostColours = colour->source;
    } else {
        view.current.source = session.data.source;
        view.canBake = planet::heightSourceExists(view.current.source);
    }
    if (session.bake) {
        view.running = session.bake->request;
        view.stopping = session.bake->stopping();
        if (session.bake->job) view.progress = session.bake->job->progress();
    }
    if (session.bakeProblem) view.lastProblem = messageOf(*session.bakeProblem);
    view.lastReport = session.bakeReport;
    return view;
}

ui::DataView dataViewOf(const Session& session, std::span<const fs::path> recent) {
    ui::DataView view;
    const OpenPlanet* open = shownPlanet(session);
    const DataSet& data = open ? open->data : session.data;
    view.name = sourceName(data.source);
    view.source = data.source;
    view.chunkFile = data.chunkFile;
    view.isFirstLook = open && open->isFirstLook;
    view.hasColourImage = open && (open->scene.hasColourImage || !open->scene.colourImage.empty());
    view.isReadingColourImage = open && open->scene.colourReading != nullptr;
    view.hasPreviousBake = session.previous.has_value();
    view.showsPreviousBake = session.showsPrevious;
    if (session.previous) view.previousName = summaryOf(*session.previous);
    if (session.problem) view.problem = messageOf(*session.problem);
    view.recent = recent;
    return view;
}

bool shadersHaveChanged(const Session& session) {
    return session.open && !session.shaders.folder.empty() &&
           newestIn(session.shaders.folder) != session.shaders.changed;
}

Result<void> reloadChangedShaders(Session& session, const Log& log) {
    if (!shadersHaveChanged(session)) return {};
    session.shaders.changed = newestIn(session.shaders.folder);
    Result<void> reloaded = session.open->scene.renderer.chunks().reloadShaders();
    if (reloaded) log.info("Shaders of {} reloaded", session.shaders.folder.string());
    return reloaded;
}

}  // namespace worldy
