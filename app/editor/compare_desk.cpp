#include "app/editor/compare_desk.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "app/flight/flight_path_file.h"
#include "app/measure/cracks.h"
#include "app/scene/overlay_colours.h"
#include "app/scene/overlay_lines.h"
#include "app/settings/settings_text.h"
#include "planet/measure/true_error.h"

namespace worldy {

namespace {

using planet::Result;

// Settings that are one for both.
ViewSettings withSharedOf(ViewSettings settings, const ViewSettings& a) {
    settings.camera = a.camera;
    settings.cracks = a.cracks;
    settings.compare = a.compare;
    return settings;
}

Result<ViewSettings> settingsFor(const ui::StartCompare& wanted, const PresetShelf& presets,
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

// Of the planet; a drawn picture stretches nothing.
double radiusOf(const Scene& scene) {
    return scene.planet->tree().shape.radiusM;
}

void beginMeters(CompareDesk& desk, const Scene& a) {
    desk.meters = {};
    desk.meters[0].bytesReadBefore = a.planet->paging().bytesRead();
    if (desk.other) desk.meters[1].bytesReadBefore = desk.other->planet.scene.planet->paging().bytesRead();
    desk.measuredOf.reset();
    desk.difference.reset();
    desk.lastScene = a.identity;
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

// What both pictures are mixed into, and by.
Result<void> prepareMixing(CompareDesk& desk, const planet::gl::RenderTarget& like) {
    if (!desk.comparer) {
        Result<planet::gl::PictureComparer> comparer = planet::gl::PictureComparer::create();
        if (!comparer) return tl::unexpected(comparer.error());
        desk.comparer.emplace(std::move(*comparer));
    }
    if (desk.mixed && desk.mixed->widthPx() == like.widthPx() && desk.mixed->heightPx() == like.heightPx())
        return {};
    desk.mixed.reset();
    Result<planet::gl::RenderTarget> mixed =
        planet::gl::RenderTarget::create(like.widthPx(), like.heightPx());
    if (!mixed) return tl::unexpected(mixed.error());
    desk.mixed.emplace(std::move(*mixed));
    return {};
}

void drawB(CompareDesk& desk, Viewport& viewport, const ChunkFocus& focus, const Log& log) {
    ComparedOther& b = *desk.other;
    const planet::Planet& planet = *b.planet.scene.planet;
    const planet::Selection& drawn = planet.selection();
    PictureContent content;
    content.view = viewport.main.view;
    const ErrorMeter& errors = desk.meters[1].errors;
    const std::vector<planet::gl::ChunkTint> tints = chunkTints(
        planet, drawn, b.settings.overlay, b.settings.lod.tauPx, errors.last ? &*errors.last : nullptr);
    content.tints = tints;
    content.hiddenLines = linesOver(b.planet.scene, drawn, content.view, b.settings);
    content.frontLines = focusLines(planet.tree(), focus, content.view);
    drawPicture(viewport, desk.picture, b.planet.scene, comparedSettings(b.settings), content, log);
}

// Takes what the flight's job has made.
void advanceFlight(CompareDesk& desk) {
    if (!desk.job) return;
    std::optional<Result<ComparedPair>> result = desk.job->takeResult();
    if (!result) return;
    desk.job.reset();
    if (*result)
        desk.flown = **result;
    else if (result->error().kind == planet::ErrorKind::Cancelled)
        desk.flownProblem = "Cancelled.";
    else
        desk.flownProblem = result->error().message;
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

void findDifferences(CompareDesk& desk, const ViewSettings& settings) {
    std::pair<ViewSettings, ViewSettings> of{settings, desk.other->settings};
    if (desk.differentOf == of) return;
    Settings a, b;
    a.view = of.first;
    b.view = of.second;
    desk.different = differences(a, b);
    desk.differentOf = std::move(of);
}

std::string sidesText(const CompareDesk& desk) {
    std::string a, b;
    for (const SettingDifference& one : desk.different) {
        a += fmt::format("{}{} {}", a.empty() ? "" : ", ", one.label, one.here);
        b += fmt::format("{}{} {}", b.empty() ? "" : ", ", one.label, one.there);
    }
    if (a.empty()) return "Settings are equal.";
    return fmt::format("A: {}. B: {}.", a, b);
}

}  // namespace

Result<void> startCompare(CompareDesk& desk, const Session& session, const PresetShelf& presets,
                          const ViewSettings& settings, const ui::StartCompare& wanted) {
    const OpenPlanet* a = shownPlanet(session);
    if (!a) return {};
    const auto opened = [&]() -> Result<ComparedOther> {
        Result<ViewSettings> settingsOfB = settingsFor(wanted, presets, settings);
        if (!settingsOfB) return tl::unexpected(settingsOfB.error());
        Result<OpenPlanet> planet = openFor(wanted, session, *settingsOfB);
        if (!planet) return tl::unexpected(planet.error());
        if (const Result<void> good = checkSameRadius(radiusOf(a->scene), radiusOf(planet->scene)); !good)
            return tl::unexpected(good.error());
        return ComparedOther{
            std::move(*planet), withSharedOf(std::move(*settingsOfB), settings), originOf(wanted), {}};
    };
    Result<ComparedOther> other = opened();
    if (!other) {
        desk.problem = other.error().message;
        return tl::unexpected(other.error());
    }
    desk.problem.clear();
    desk.ending = false;
    desk.other.emplace(std::move(*other));
    beginMeters(desk, a->scene);
    return {};
}

void stopCompare(CompareDesk& desk) {
    desk.other.reset();
    desk.meters = {};
    desk.measuredOf.reset();
    desk.difference.reset();
    desk.different.clear();
    desk.differentOf.reset();
    desk.picture.target.reset();
    desk.mixed.reset();
    desk.comparer.reset();
}

void forgetPopsOfA(CompareDesk& desk) {
    desk.meters[0].pops.clear();
}

ViewSettings swapCompared(CompareDesk& desk, Session& session, const ViewSettings& settings, const Log& log) {
    if (!desk.other || !shownScene(session)) return settings;
    ViewSettings settingsOfA = std::exchange(desk.other->settings, settings);
    if (shownPlanet(session)->data.chunkFile != desk.other->planet.data.chunkFile)
        exchangeShown(session, desk.other->planet, log);
    desk.other->origin = "what was A";
    beginMeters(desk, *shownScene(session));
    return withSharedOf(std::move(settingsOfA), settings);
}

void stepCompared(CompareDesk& desk, const CompareFrame& now, const Log& log) {
    advanceFlight(desk);
    if (std::exchange(desk.ending, false)) stopCompare(desk);
    if (!desk.other) return;
    Scene& b = desk.other->planet.scene;
    if (now.a.identity != desk.lastScene) {
        const Result<void> same = checkSameRadius(radiusOf(now.a), radiusOf(b));
        if (!same) {
            desk.problem = same.error().message;
            log->warn("Comparison ended: {}", same.error().message);
            return stopCompare(desk);
        }
        beginMeters(desk, now.a);
    }
    desk.other->settings = withSharedOf(std::move(desk.other->settings), now.settings);
    if (const auto applied = applyLiveSettings(b, desk.other->settings, now.pagingPaused); !applied)
        log->error("B: {}", applied.error().message);
    if (now.goesOn) {
        stepScene(b, now.lodView, desk.other->settings);
        keepPops(now.a, now, desk.meters[0].pops);
        keepPops(b, now, desk.meters[1].pops);
    } else {
        b.drawCpuMs = 0;
        b.drawn = {};
    }
    for (const std::string& problem : takeProblems(b)) log->error("B: {}", problem);
    advanceErrorMeter(*now.a.planet, now.frame, now.timeS, desk.meters[0].errors);
    advanceErrorMeter(*b.planet, now.frame, now.timeS, desk.meters[1].errors);
}

void drawCompared(CompareDesk& desk, Viewport& viewport, const ViewSettings& settings,
                  const ChunkFocus& focus, bool counting, const Log& log) {
    viewport.main.instead = nullptr;
    viewport.main.mix = {};
    if (!desk.other || !viewport.main.shown() || !viewport.main.target) return;
    drawB(desk, viewport, focus, log);
    desk.other->stats = smoothed(desk.other->stats, statsOf(desk.other->planet.scene));
    if (!desk.picture.target) return;
    const planet::gl::RenderTarget& a = *viewport.main.target;
    if (const Result<void> ready = prepareMixing(desk, a); !ready) {
        desk.problem = ready.error().message;
        log->error("{}", desk.problem);
        return stopCompare(desk);
    }
    const GLuint pictureA = a.colourTexture();
    const GLuint pictureB = desk.picture.target->colourTexture();
    const planet::gl::PictureMix mix = mixOf(settings.compare, a.widthPx());
    desk.mixed->bind();
    desk.comparer->draw(pictureA, pictureB, a.widthPx(), a.heightPx(), mix);
    viewport.main.instead = &*desk.mixed;
    viewport.main.mix = mix;
    desk.difference.reset();
    if (!counting || desk.other->planet.scene.renderer.chunks().counters().standIn) return;
    const planet::gl::PictureDifference counted =
        desk.comparer->count(pictureA, pictureB, a.widthPx(), a.heightPx());
    desk.difference = {counted.pixels,
                       static_cast<std::uint64_t>(a.widthPx()) * static_cast<std::uint64_t>(a.heightPx()),
                       counted.largestSteps};
}

Result<void> measureCompared(CompareDesk& desk, Scene& a, const ViewSettings& settings,
                             const planet::View& view) {
    if (!desk.other) return {};
    Result<CrackMeasurement> cracksOfA = measureCracks(a, view, settings);
    if (!cracksOfA) return tl::unexpected(cracksOfA.error());
    Result<CrackMeasurement> cracksOfB = measureCracks(desk.other->planet.scene, view, desk.other->settings);
    if (!cracksOfB) return tl::unexpected(cracksOfB.error());
    desk.meters[0].cracks = std::move(*cracksOfA);
    desk.meters[1].cracks = std::move(*cracksOfB);
    for (ComparedMeters& meters : desk.meters) {
        meters.errors.last.reset();
        meters.errors.wanted = true;
    }
    desk.measuredOf = {view, settings, desk.other->settings};
    return {};
}

Result<void> compareFlight(CompareDesk& desk, const Session& session, const ViewSettings& settings,
                           const planet::View& view, const ui::CompareOverFlight& wanted) {
    const OpenPlanet* a = shownPlanet(session);
    if (!a || !desk.other || desk.job) return {};
    Result<FlightPath> path = loadFlightPath(wanted.flight);
    if (!path) {
        desk.flownProblem = path.error().message;
        return tl::unexpected(path.error());
    }
    ComparisonPlan plan;
    plan.sides[0] = {a->data.chunkFile, settings};
    plan.sides[1] = {desk.other->planet.data.chunkFile, desk.other->settings};
    plan.path = std::move(*path);
    plan.moments = std::max(wanted.moments, 1);
    plan.size = {std::max(view.widthPx, 16), std::max(view.heightPx, 16)};
    findDifferences(desk, settings);
    desk.flownName = fmt::format("{}, {} sample frames. {}", plan.path.name, plan.moments, sidesText(desk));
    desk.flownProblem.clear();
    desk.flown.reset();
    desk.job = std::make_unique<ComparisonJob>(std::move(plan));
    return {};
}

ui::CompareView compareViewOf(CompareDesk& desk, const Session& session, const ViewSettings& settings,
                              const FrameStats& statsOfA, const planet::View& view) {
    ui::CompareView shown;
    shown.problem = desk.problem;
    shown.flight.running = desk.job != nullptr;
    shown.flight.stopping = desk.job && desk.job->cancelling();
    shown.flight.progress = desk.job ? desk.job->progress() : 0;
    shown.flight.last = desk.flown ? &*desk.flown : nullptr;
    shown.flight.lastName = desk.flownName;
    shown.flight.problem = desk.flownProblem;
    const OpenPlanet* a = shownPlanet(session);
    if (!desk.other || !a) return shown;
    const ComparedOther& b = *desk.other;
    findDifferences(desk, settings);
    shown.on = true;
    shown.planetB = b.planet.scene.planet.get();
    shown.settingsB = &b.settings;
    shown.fileA = a->data.chunkFile;
    shown.fileB = b.planet.data.chunkFile;
    shown.origin = b.origin;
    shown.different = desk.different;
    shown.now = {figuresOf(statsOfA, desk.meters[0]), figuresOf(b.stats, desk.meters[1])};
    shown.difference = desk.difference;
    for (const ComparedMeters& meters : desk.meters) {
        shown.measuring = shown.measuring || meters.errors.job || meters.errors.wanted;
        const double done = meters.errors.last ? 1 : meters.errors.job ? meters.errors.job->progress() : 0;
        shown.measured += done / 2;
    }
    if (desk.measuredOf) {
        const MeasuredOf& of = *desk.measuredOf;
        shown.stale = of.view != view || !(of.settingsOfB == withSharedOf(b.settings, of.settings)) ||
                      !(withSharedOf(of.settings, settings) == settings);
    }
    return shown;
}

std::size_t gpuBytes(const CompareDesk& desk) {
    const auto bytesOf = [](const auto& part) { return part ? part->gpuBytes() : 0; };
    return bytesOf(desk.picture.target) + bytesOf(desk.mixed);
}

}  // namespace worldy
