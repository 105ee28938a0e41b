#include "app/editor/compare_controller.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "app/base/text.h"
#include "app/flight/flight_path_file.h"
#include "app/measure/cracks.h"
#include "app/scene/overlay_colours.h"
#include "app/scene/overlay_lines.h"
#include "app/settings/settings_text.h"
#include "planet/base/try.h"
#include "planet/measure/true_error.h"

namespace worldy {

namespace {

using planet::Result;

// Returns the settings with those that both planets share taken from A.
ViewSettings withSharedOf(ViewSettings settings, const ViewSettings& a) {
    settings.camera = a.camera;
    settings.cracks = a.cracks;
    settings.compare = a.compare;
    return settings;
}

Result<ViewSettings> settingsFor(const ui::StartCompare& wanted, const PresetLibrary& presets,
                                 const ViewSettings& settings) {
    if (wanted.with == ui::StartCompare::With::Preset) return presets.load(wanted.preset, settings);
    return settings;
}

std::string originOf(const ui::StartCompare& wanted) {
    switch (wanted.with) {
        case ui::StartCompare::With::SettingsKept:
            return "snapshot";
        case ui::StartCompare::With::Preset:
            return "preset " + wanted.preset;
        case ui::StartCompare::With::PreviousBake:
            return "the other bake";
        case ui::StartCompare::With::File:
            return "another file";
    }
    return {};
}

Result<OpenPlanet> openFor(const ui::StartCompare& wanted, const Session& session,
                           const ViewSettings& settings) {
    if (wanted.with == ui::StartCompare::With::File) return openBeside(session, wanted.file, settings);
    if (wanted.with == ui::StartCompare::With::PreviousBake) {
        if (!session.previous) return planet::badInput("There is no previous bake; bake again to create one");
        return openBeside(session, session.showsPrevious ? session.open->data : session.previous->data,
                          settings);
    }
    return openBeside(session, shownPlanet(session)->data, settings);
}

// Returns the planet's radius, metres. Vertical exaggeration does not change it.
double radiusOf(const Scene& scene) {
    return scene.planet->tree().shape.radiusM;
}

void beginMeters(CompareController& controller, const Scene& a) {
    controller.meters = {};
    controller.meters[0].bytesReadBefore = a.planet->paging().bytesRead();
    if (controller.other)
        controller.meters[1].bytesReadBefore = controller.other->planet.scene.planet->paging().bytesRead();
    controller.measuredOf.reset();
    controller.difference.reset();
    controller.lastScene = a.identity;
}

void keepPops(const Scene& scene, const CompareFrame& now, planet::PopMeter& pops) {
    const planet::Planet& planet = *scene.planet;
    pops.add(planet.tree(), planet.selection(), now.view, planet.views()[0].input.lod, now.timeS,
             {.cameraJumped = now.cameraJumped, .seaM = scene.seaSurfaceM});
}

planet::gl::PictureMix mixOf(const CompareSettings& shown, int widthPx) {
    switch (shown.mode) {
        case CompareMode::SideBySide:
            return planet::gl::sideBySideMix(widthPx);
        case CompareMode::Wipe:
            return planet::gl::wipeMix(widthPx, shown.wipe);
        case CompareMode::Difference:
            return planet::gl::differenceMix(shown.gain);
        case CompareMode::Flip:
            return planet::gl::onlyMix(widthPx, shown.showB);
    }
    return {};
}

// Creates the comparer and the render target that both pictures are mixed into, unless they exist.
Result<void> prepareMixing(CompareController& controller, const planet::gl::RenderTarget& like) {
    if (!controller.comparer) {
        Result<planet::gl::PictureComparer> comparer = planet::gl::PictureComparer::create();
        if (!comparer) return tl::unexpected(comparer.error());
        controller.comparer.emplace(std::move(*comparer));
    }
    if (controller.mixed && controller.mixed->widthPx() == like.widthPx() &&
        controller.mixed->heightPx() == like.heightPx())
        return {};
    controller.mixed.reset();
    Result<planet::gl::RenderTarget> mixed =
        planet::gl::RenderTarget::create(like.widthPx(), like.heightPx());
    if (!mixed) return tl::unexpected(mixed.error());
    controller.mixed.emplace(std::move(*mixed));
    return {};
}

void drawB(CompareController& controller, Viewport& viewport, const ChunkFocus& focus, const Log& log) {
    ComparedOther& b = *controller.other;
    const planet::Planet& planet = *b.planet.scene.planet;
    const planet::Selection& drawn = planet.selection();
    PictureContent content;
    content.view = viewport.main.view;
    const ErrorMeter& errors = controller.meters[1].errors;
    const std::vector<planet::gl::ChunkTint> tints =
        chunkTints(planet, drawn, b.settings.overlay, b.settings.lod.tauPx,
                   {.measured = errors.last ? &*errors.last : nullptr});
    content.tints = tints;
    content.hiddenLines = linesOver(b.planet.scene, drawn, content.view, b.settings);
    content.frontLines = focusLines(planet.tree(), focus, content.view);
    drawPicture(viewport, controller.picture, b.planet.scene, comparedSettings(b.settings), content, log);
}

// Takes the result of the flight's job.
void advanceFlight(CompareController& controller, const Log& log) {
    if (!controller.flight.job) return;
    std::optional<Result<ComparedPair>> result = controller.flight.job->takeResult();
    if (!result) return;
    controller.flight.job.reset();
    if (*result) {
        controller.flight.last = **result;
        return;
    }
    controller.flight.cancelled = result->error().kind == planet::ErrorKind::Cancelled;
    controller.flight.problem = controller.flight.cancelled ? "Cancelled." : result->error().message;
    if (!controller.flight.cancelled) log.error("{}", controller.flight.problem);
}

ComparedFigures figuresOf(const FrameStats& stats, const ComparedMeters& meters) {
    ComparedFigures figures;
    figures.groundTriangles = static_cast<double>(stats.selection.groundTriangles);
    figures.skirtTriangles = static_cast<double>(stats.selection.skirtTriangles);
    figures.triangles = static_cast<double>(stats.selection.triangles());
    figures.chunks = stats.selection.drawn;
    figures.residentBytes =
        static_cast<double>(stats.paging.residentBytesCpu + stats.paging.residentBytesGpu);
    const std::uint64_t bytesRead = stats.paging.bytesRead();
    figures.bytesRead = static_cast<double>(bytesRead - std::min(meters.bytesReadBefore, bytesRead));
    figures.selectMs = stats.stages.selectMs;
    figures.drawMs = stats.render.chunksMs + stats.render.skyMs + stats.render.shadowsMs;
    figures.worstEpsPx = static_cast<double>(stats.selection.worstEpsPx);
    figures.worstDrawnBoundPx = static_cast<double>(stats.selection.worstDrawnBoundPx);
    const planet::PopTotals& pops = meters.pops.totals();
    figures.switches = static_cast<double>(pops.switches);
    figures.worstPopPx = pops.worstPx;
    figures.p99PopPx = meters.pops.percentilePx(0.99);
    figures.late = static_cast<double>(pops.late);
    if (meters.errors.last) {
        const planet::TrueErrorReport& report = meters.errors.last->report;
        figures.worstErrorPx = report.worstFacingPx;
        figures.p99ErrorPx = report.p99FacingPx;
        figures.violations = report.violations;
    }
    if (meters.cracks) {
        figures.crackPx = static_cast<double>(meters.cracks->map.pixels.size());
        figures.leakingPx = meters.cracks->map.leaking;
    }
    return figures;
}

void findDifferences(CompareController& controller, const ViewSettings& settings) {
    std::pair<ViewSettings, ViewSettings> of{settings, controller.other->settings};
    if (controller.differentOf == of) return;
    Settings a, b;
    a.view = of.first;
    b.view = of.second;
    controller.different = differences(a, b);
    controller.differentOf = std::move(of);
}

// Starts comparing A with B, unless B could not be opened.
Result<void> begin(CompareController& controller, const Scene& a, const ViewSettings& settings,
                   Result<ComparedOther> b) {
    if (b) {
        const Result<void> same = checkSameRadius(radiusOf(a), radiusOf(b->planet.scene));
        if (!same) b = tl::unexpected(same.error());
    }
    if (!b) {
        controller.problem = b.error().message;
        return tl::unexpected(b.error());
    }
    b->settings = withSharedOf(std::move(b->settings), settings);
    controller.problem.clear();
    controller.ending = false;
    controller.other.emplace(std::move(*b));
    beginMeters(controller, a);
    return {};
}

std::string sidesText(const CompareController& controller) {
    std::string a, b;
    for (const SettingDifference& one : controller.different) {
        a += fmt::format("{}{} {}", a.empty() ? "" : ", ", one.label, one.here);
        b += fmt::format("{}{} {}", b.empty() ? "" : ", ", one.label, one.there);
    }
    if (a.empty()) return "Settings are equal.";
    return fmt::format("A: {}. B: {}.", a, b);
}

}  // namespace

Result<void> startCompare(CompareController& controller, const Session& session, const PresetLibrary& presets,
                          const ViewSettings& settings, const ui::StartCompare& wanted) {
    const OpenPlanet* a = shownPlanet(session);
    if (!a) return {};
    return begin(controller, a->scene, settings, [&]() -> Result<ComparedOther> {
        TRY_ASSIGN(ViewSettings settingsOfB, settingsFor(wanted, presets, settings));
        TRY_ASSIGN(OpenPlanet planet, openFor(wanted, session, settingsOfB));
        return ComparedOther{std::move(planet), std::move(settingsOfB), originOf(wanted), {}};
    }());
}

LastComparison lastComparisonOf(const ComparedOther& other, const OpenPlanet& a) {
    LastComparison last{.origin = other.origin, .settings = withSharedOf(other.settings, {})};
    const std::filesystem::path& file = other.planet.data.chunkFile;
    if (file != a.data.chunkFile) last.file = std::filesystem::absolute(file);
    return last;
}

Result<void> resumeCompare(CompareController& controller, const Session& session, const LastComparison& last,
                           const ViewSettings& settings) {
    const OpenPlanet* a = shownPlanet(session);
    if (!a) return {};
    return begin(controller, a->scene, settings, [&]() -> Result<ComparedOther> {
        TRY_ASSIGN(OpenPlanet planet, last.file.empty() ? openBeside(session, a->data, last.settings)
                                                        : openBeside(session, last.file, last.settings));
        return ComparedOther{std::move(planet), last.settings, last.origin, {}};
    }());
}

void stopCompare(CompareController& controller) {
    controller.other.reset();
    controller.meters = {};
    controller.measuredOf.reset();
    controller.difference.reset();
    controller.different.clear();
    controller.differentOf.reset();
    controller.picture.target.reset();
    controller.mixed.reset();
    controller.comparer.reset();
}

void forgetPopsOfA(CompareController& controller) {
    controller.meters[0].pops.clear();
}

ViewSettings swapCompared(CompareController& controller, Session& session, const ViewSettings& settings) {
    if (!controller.other || !shownScene(session)) return settings;
    ViewSettings settingsOfA = std::exchange(controller.other->settings, settings);
    if (shownPlanet(session)->data.chunkFile != controller.other->planet.data.chunkFile)
        exchangeShown(session, controller.other->planet);
    controller.other->origin = "previous A";
    beginMeters(controller, *shownScene(session));
    return withSharedOf(std::move(settingsOfA), settings);
}

void stepCompared(CompareController& controller, const CompareFrame& now, const Log& log) {
    advanceFlight(controller, log);
    if (std::exchange(controller.ending, false)) stopCompare(controller);
    if (!controller.other) return;
    Scene& b = controller.other->planet.scene;
    if (now.a.identity != controller.lastScene) {
        const Result<void> same = checkSameRadius(radiusOf(now.a), radiusOf(b));
        if (!same) {
            controller.problem = same.error().message;
            log.warn("Comparison ended: {}", same.error().message);
            return stopCompare(controller);
        }
        beginMeters(controller, now.a);
    }
    controller.other->settings = withSharedOf(std::move(controller.other->settings), now.settings);
    if (const auto applied = applyLiveSettings(b, controller.other->settings, now.pagingPaused); !applied)
        log.error("B: {}", applied.error().message);
    if (now.goesOn) {
        stepScene(b, now.lodView, controller.other->settings);
        keepPops(now.a, now, controller.meters[0].pops);
        keepPops(b, now, controller.meters[1].pops);
    } else {
        b.drawCpuMs = 0;
        b.drawn = {};
    }
    for (const std::string& problem : takeProblems(b)) log.error("B: {}", problem);
    advanceErrorMeter(*now.a.planet, now.frame, controller.meters[0].errors);
    advanceErrorMeter(*b.planet, now.frame, controller.meters[1].errors);
}

void drawCompared(CompareController& controller, Viewport& viewport, const ViewSettings& settings,
                  const ChunkFocus& focus, bool counting, const Log& log) {
    viewport.main.instead = nullptr;
    viewport.main.mix = {};
    if (!controller.other || !viewport.main.shown() || !viewport.main.target) return;
    drawB(controller, viewport, focus, log);
    controller.other->stats = smoothed(controller.other->stats, statsOf(controller.other->planet.scene));
    if (!controller.picture.target) return;
    const planet::gl::RenderTarget& a = *viewport.main.target;
    if (const Result<void> ready = prepareMixing(controller, a); !ready) {
        controller.problem = ready.error().message;
        log.error("{}", controller.problem);
        return stopCompare(controller);
    }
    const GLuint pictureA = a.colourTexture();
    const GLuint pictureB = controller.picture.target->colourTexture();
    const planet::gl::PictureMix mix = mixOf(settings.compare, a.widthPx());
    controller.mixed->bind();
    controller.comparer->draw(pictureA, pictureB, a.widthPx(), a.heightPx(), mix);
    viewport.main.instead = &*controller.mixed;
    viewport.main.mix = mix;
    controller.difference.reset();
    if (!counting || controller.other->planet.scene.renderer.chunks().counters().standIn) return;
    const planet::gl::PictureDifference counted =
        controller.comparer->count(pictureA, pictureB, a.widthPx(), a.heightPx());
    controller.difference = {
        counted.pixels, static_cast<std::uint64_t>(a.widthPx()) * static_cast<std::uint64_t>(a.heightPx()),
        counted.largestSteps};
}

Result<void> measureCompared(CompareController& controller, Scene& a, const ViewSettings& settings,
                             const planet::View& view) {
    if (!controller.other) return {};
    Result<CrackMeasurement> cracksOfA = measureCracks(a, view, settings);
    if (!cracksOfA) return tl::unexpected(cracksOfA.error());
    Result<CrackMeasurement> cracksOfB =
        measureCracks(controller.other->planet.scene, view, controller.other->settings);
    if (!cracksOfB) return tl::unexpected(cracksOfB.error());
    controller.meters[0].cracks = std::move(*cracksOfA);
    controller.meters[1].cracks = std::move(*cracksOfB);
    for (ComparedMeters& meters : controller.meters) {
        meters.errors.last.reset();
        meters.errors.wanted = true;
    }
    controller.measuredOf = {view, settings, controller.other->settings};
    return {};
}

Result<void> compareFlight(CompareController& controller, const Session& session,
                           const ViewSettings& settings, const planet::View& view,
                           const ui::CompareOverFlight& wanted) {
    const OpenPlanet* a = shownPlanet(session);
    if (!a || !controller.other || controller.flight.job) return {};
    Result<FlightPath> path = loadFlightPath(wanted.flight);
    if (!path) {
        controller.flight.problem = path.error().message;
        return tl::unexpected(path.error());
    }
    ComparisonPlan plan;
    plan.sides[0] = {a->data.chunkFile, settings};
    plan.sides[1] = {controller.other->planet.data.chunkFile, controller.other->settings};
    plan.path = std::move(*path);
    plan.moments = std::max(wanted.moments, 1);
    plan.size = {std::max(view.widthPx, 16), std::max(view.heightPx, 16)};
    findDifferences(controller, settings);
    controller.flight.name =
        fmt::format("{}, {} sample frames. {}", plan.path.name, plan.moments, sidesText(controller));
    controller.flight.files = {measuredFileOf(plan.sides[0].chunkFile),
                               measuredFileOf(plan.sides[1].chunkFile)};
    controller.flight.problem.clear();
    controller.flight.cancelled = false;
    controller.flight.last.reset();
    controller.flight.job = std::make_unique<ComparisonJob>(std::move(plan));
    return {};
}

void keepResults(const ComparedFlight& flight, KeptResults& kept) {
    if (flight.last) kept.flight = KeptFlight{flight.name, *flight.last, flight.files};
}

void restoreResults(ComparedFlight& flight, const KeptResults& kept, const Log& log) {
    if (!kept.flight) return;
    if (const std::string changed = changedSince(kept.flight->files); !changed.empty()) {
        flight.problem =
            fmt::format("{}; the comparison over a flight of the last session is not shown", changed);
        return log.warn("{}", flight.problem);
    }
    flight.last = kept.flight->figures;
    flight.name = kept.flight->name;
    flight.files = kept.flight->files;
}

ui::CompareView compareViewOf(CompareController& controller, const Session& session,
                              const ViewSettings& settings, const FrameStats& statsOfA,
                              const planet::View& view) {
    ui::CompareView shown;
    shown.problem = controller.problem;
    shown.flight.running = controller.flight.job != nullptr;
    shown.flight.stopping = controller.flight.job && controller.flight.job->cancelling();
    shown.flight.progress = controller.flight.job ? controller.flight.job->progress() : 0;
    shown.flight.last = controller.flight.last ? &*controller.flight.last : nullptr;
    shown.flight.lastName = controller.flight.name;
    shown.flight.problem = controller.flight.problem;
    const OpenPlanet* a = shownPlanet(session);
    if (!controller.other || !a) return shown;
    const ComparedOther& b = *controller.other;
    findDifferences(controller, settings);
    shown.on = true;
    shown.planetB = b.planet.scene.planet.get();
    shown.settingsB = &b.settings;
    shown.fileA = a->data.chunkFile;
    shown.fileB = b.planet.data.chunkFile;
    const bool hasOneSource = a->data.source == b.planet.data.source;
    const auto nameOf = [&](const DataSet& data) {
        return hasOneSource ? data.chunkFile.filename().string() : sourceName(data.source);
    };
    shown.names = {nameOf(a->data), nameOf(b.planet.data)};
    shown.origin = b.origin;
    shown.different = controller.different;
    shown.now = {figuresOf(statsOfA, controller.meters[0]), figuresOf(b.stats, controller.meters[1])};
    shown.difference = controller.difference;
    for (const ComparedMeters& meters : controller.meters) {
        shown.measuring = shown.measuring || meters.errors.job || meters.errors.wanted;
        const double done = meters.errors.last ? 1 : meters.errors.job ? meters.errors.job->progress() : 0;
        shown.measured += done / 2;
    }
    if (controller.measuredOf) {
        const MeasuredOf& of = *controller.measuredOf;
        shown.stale = of.view != view || !(of.settingsOfB == withSharedOf(b.settings, of.settings)) ||
                      !(withSharedOf(of.settings, settings) == settings);
    }
    return shown;
}

std::size_t gpuBytes(const CompareController& controller) {
    const auto bytesOf = [](const auto& part) { return part ? part->gpuBytes() : 0; };
    return bytesOf(controller.picture.target) + bytesOf(controller.mixed);
}

namespace {

struct CompareHandler {
    CompareController& controller;
    const CompareContext& context;
    Notices& notices;

    const ViewSettings& settings() const { return context.settings.settings.view; }

    void operator()(const ui::StartCompare& command) const {
        if (succeeded(
                notices,
                startCompare(controller, context.session, context.settings.presets, settings(), command),
                "B cannot be shown"))
            context.stepOnce = true;  // B has selected nothing yet
    }
    void operator()(const ui::StopCompare&) const { controller.ending = true; }
    void operator()(const ui::SwapCompare&) const {
        if (!mayChange("Settings", context.replaying, notices.log)) return;
        replaceView(context.settings, swapCompared(controller, context.session, settings()),
                    "swap of A and B");
        context.stepOnce = true;
    }
    void operator()(const ui::MeasureCompare&) const {
        Scene* scene = shownScene(context.session);
        if (scene && context.view)
            succeeded(notices, measureCompared(controller, *scene, settings(), *context.view),
                      "This view was not measured");
    }
    void operator()(const ui::CompareOverFlight& command) const {
        if (context.view)
            succeeded(notices, compareFlight(controller, context.session, settings(), *context.view, command),
                      "The flight was not measured");
    }
    void operator()(const ui::CancelCompareFlight&) const {
        if (controller.flight.job) controller.flight.job->cancel();
    }
};

}  // namespace

void execute(CompareController& controller, const ui::CompareCommand& command, const CompareContext& context,
             Notices& notices) {
    std::visit(CompareHandler{controller, context, notices}, command);
}

}  // namespace worldy
