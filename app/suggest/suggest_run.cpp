#include "app/suggest/suggest_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "app/base/stopwatch.h"
#include "app/base/text.h"
#include "app/flight/flight_path_file.h"
#include "app/flight/flight_record.h"
#include "app/measure/atlas_survey.h"
#include "app/measure/sweep_files.h"
#include "app/scene/offscreen.h"
#include "app/scene/scene_settings.h"
#include "app/settings/region_file.h"
#include "app/settings/settings_schema.h"
#include "app/settings/settings_text.h"
#include "app/settings/shot_line.h"
#include "app/suggest/suggest_plans.h"
#include "planet/bake/bake_report.h"
#include "planet/base/result.h"
#include "planet/base/try.h"
#include "planet/format/chunk_file.h"
#include "planet/planet.h"

namespace worldy {

namespace {

using planet::Result;
namespace fs = std::filesystem;

constexpr auto frameMsIndex = static_cast<std::size_t>(SuggestLimit::FrameMs);

// Says how the search goes on, with the time that is left.
class SuggestClock {
public:
    explicit SuggestClock(const SuggestWatcher& watcher) : watcher_(watcher) {}

    void enter(SuggestStage stage) { progress_ = {.stage = stage, .measured = progress_.measured}; }
    bool goOn(double share) {
        progress_.share = share;
        progress_.leftS = leftS();
        return watcher_.progress(progress_);
    }
    void begin(const SuggestCandidate& candidate, SuggestScope scope) {
        progress_.candidate = candidate;
        scope_ = scope;
        began_ = {};
    }
    void beginBake(int chunkSize) { progress_.candidate.chunkSize = chunkSize; }
    void end() {
        Times& times = of(scope_);
        times.sumS += began_.elapsedMs() / 1000;
        ++times.count;
        if (times.ahead > 0) --times.ahead;
        ++progress_.measured;
        progress_.ahead = times_[0].ahead + times_[1].ahead;
    }
    void setAhead(std::size_t samples, std::size_t wholes) {
        of(SuggestScope::Sample).ahead = samples;
        of(SuggestScope::Whole).ahead = wholes;
        progress_.ahead = samples + wholes;
    }

private:
    struct Times {
        double sumS = 0;
        std::size_t count = 0;
        std::size_t ahead = 0;
    };
    Times& of(SuggestScope scope) { return times_[static_cast<std::size_t>(scope)]; }
    std::optional<double> leftS() const {
        if (progress_.stage != SuggestStage::Searching) return std::nullopt;
        double left = 0;
        for (const Times& times : times_) {
            if (times.ahead > 0 && times.count == 0) return std::nullopt;
            if (times.count > 0)
                left += times.sumS / static_cast<double>(times.count) * static_cast<double>(times.ahead);
        }
        return left;
    }

    const SuggestWatcher& watcher_;
    SuggestProgress progress_;
    SuggestScope scope_ = SuggestScope::Whole;
    Stopwatch began_;
    std::array<Times, 2> times_{};
};

Result<SuggestLeg> recordedLeg(const fs::path& file, const FlightRecord& record,
                               const planet::ChunkFile& chunks) {
    TRY(checkSameData(file, record.data, flightDataOf(chunks)));
    if (record.frames.empty())
        return planet::badInput(fmt::format("{}: has no frames; expected at least one", file.string()));
    return legOf(record);
}

Result<SuggestLeg> surveyedLeg(const SuggestRequest& request, SuggestClock& clock) {
    AtlasRequest survey;
    survey.file = request.file;
    survey.view = request.view;
    survey.size = request.size;
    survey.grid = *request.survey;
    survey.recordsTree = false;
    TRY_ASSIGN(const AtlasOutcome outcome,
               surveyAtlas(survey, [&](const std::optional<planet::AtlasProgress>& progress) {
                   const bool knows = progress && progress->total > 0;
                   return clock.goOn(knows ? static_cast<double>(progress->done) /
                                                 static_cast<double>(progress->total)
                                           : 0);
               }));
    return legOf(outcome.atlas);
}

Result<std::vector<SuggestLeg>> legsOf(const SuggestRequest& request, const planet::ChunkFile& chunks,
                                       SuggestClock& clock) {
    std::vector<SuggestLeg> legs;
    const auto add = [&](SuggestLeg leg, const fs::path& file) {
        if (leg.name.empty()) leg.name = flightName(file);
        legs.push_back(std::move(leg));
    };
    const double radiusM = chunks.info().shape.radiusM;
    for (const fs::path& file : request.flights) {
        if (request.viewsOfRecordings && isFlightRecord(file)) {
            const Result<FlightRecord> record = loadFlightRecord(file);
            Result<SuggestLeg> leg =
                record ? recordedLeg(file, *record, chunks) : tl::unexpected(record.error());
            if (leg) {
                if (leg->name.empty()) leg->name = flightName(file);
                leg->name += " (as recorded)";
                add(std::move(*leg), file);
                continue;
            }
        }
        TRY_ASSIGN(const FlightPath path, loadFlightPath(file));
        TRY_ASSIGN(SuggestLeg leg,
                   legOf(path, request.stepS, radiusM, request.view.camera.fovDeg, request.size));
        add(std::move(leg), file);
    }
    for (const fs::path& file : request.recordings) {
        TRY_ASSIGN(const FlightRecord record, loadFlightRecord(file));
        TRY_ASSIGN(SuggestLeg leg, recordedLeg(file, record, chunks));
        add(std::move(leg), file);
    }
    if (request.survey) {
        TRY_ASSIGN(SuggestLeg leg, surveyedLeg(request, clock));
        legs.push_back(std::move(leg));
    }
    if (legs.empty())
        return planet::badInput("there is no place to measure; expected a flight, a recording or a survey");
    return legs;
}

// Returns views spread over all legs.
std::vector<planet::View> spreadViews(const std::vector<SuggestLeg>& legs, std::size_t ofEach) {
    std::vector<planet::View> views;
    for (const SuggestLeg& leg : legs) {
        const std::size_t count = std::min(ofEach, leg.frames.size());
        for (std::size_t i = 0; i < count; ++i)
            views.push_back(leg.frames[(2 * i + 1) * leg.frames.size() / (2 * count)].view);
    }
    return views;
}

// Frames are timed and pictures are drawn without markings, which cost time.
ViewSettings drawnSettings(ViewSettings settings) {
    settings.overlay = {};
    settings.overlay.regions = false;
    settings.overlay.notes = false;
    settings.paging.badDisk = {};
    settings.paging.simulated = false;
    return settings;
}

Result<Offscreen> openDrawn(const SuggestRequest& request, const fs::path& file,
                            const ViewSettings& settings) {
    return openOffscreen({.chunkFile = file, .colourImage = request.colourImage}, settings, request.size, 1);
}

Result<std::optional<FrameCost>> frameCostOf(const SuggestRequest& request, const fs::path& file,
                                             const std::vector<SuggestLeg>& legs, SuggestClock& clock) {
    if (request.cost || !request.budget[SuggestLimit::FrameMs]) return request.cost;
    clock.enter(SuggestStage::Timing);
    const ViewSettings settings = drawnSettings(settingsWith(request.view, candidateOf(request.view)));
    Result<Offscreen> offscreen = openDrawn(request, file, settings);
    if (!offscreen) {
        return planet::badInput(fmt::format(
            "frame times cannot be measured here: {}; expected OpenGL, a --frame-cost, or no budget in ms",
            offscreen.error().message));
    }
    TRY_ASSIGN(const FrameCost cost, measureFrameCost(*offscreen, spreadViews(legs, 3), settings,
                                                      [&](double share) { return clock.goOn(share); }));
    return std::optional(cost);
}

template <class Value>
std::vector<Value> firstThen(Value now, std::initializer_list<Value> others) {
    std::vector<Value> all{now};
    for (const Value other : others) {
        if (std::ranges::find(all, other) == all.end()) all.push_back(other);
    }
    return all;
}

SuggestRanges rangesOf(const SuggestRequest& request) {
    const SuggestCandidate now = candidateOf(request.view);
    SuggestRanges ranges{.variesTau = request.vary.tau,
                         .leastTauPx = smallestTauPx,
                         .mostTauPx = largestTauPx,
                         .metrics = {now.metric},
                         .morphRanges = {now.morphRange},
                         .memoriesMiB = {now.memoryMiB}};
    for (const SweptFile& bake : request.bakes.files) ranges.chunkSizes.push_back(bake.chunkSize);
    if (request.vary.metric)
        ranges.metrics = firstThen(now.metric, {planet::ErrorMetric::Additive, planet::ErrorMetric::Tight});
    if (request.vary.morph && request.view.lod.morph)
        ranges.morphRanges = firstThen(now.morphRange, {0.15, 0.3, 0.6});
    // A paging budget above the limit fills up over time whatever is drawn, so it is never tried.
    if (request.vary.memory && request.budget[SuggestLimit::ResidentBytes]) {
        const auto& range = rangeOf("paging.budget_mb");
        const double limitMiB = std::floor(*request.budget[SuggestLimit::ResidentBytes] / (1 << 20));
        const int allowed = static_cast<int>(std::clamp(limitMiB, range.min, range.max));
        ranges.memoriesMiB =
            now.memoryMiB > allowed ? std::vector{allowed} : firstThen(now.memoryMiB, {allowed});
    }
    return ranges;
}

// A chunk file that is measured.
struct MeteredFile {
    int chunkSize = 0;  // as in candidates: 0 for the file of the request
    fs::path file;
    std::optional<FrameCost> cost;  // of a frame, for each chunk size its own
    std::unique_ptr<SuggestMeter> meter;
};

Result<MeteredFile> meteredFile(const SuggestRequest& request, int chunkSize, const fs::path& file,
                                const std::vector<SuggestLeg>& legs, SuggestClock& clock) {
    MeteredFile metered{chunkSize, file, {}, {}};
    TRY_ASSIGN(metered.cost, frameCostOf(request, file, legs, clock));
    const ViewSettings now = settingsWith(request.view, candidateOf(request.view));
    TRY_ASSIGN(auto planet,
               planet::Planet::open(file, pagingSettingsOf(now, false, planet::PagingTime::Simulated)));
    metered.meter = std::make_unique<SuggestMeter>(std::move(planet), request.view, legs, metered.cost);
    return metered;
}

// Another bake must be of the same planet: as large, and between the same heights.
Result<void> checkSamePlanet(const planet::ChunkFile& chunks, const fs::path& file) {
    TRY_ASSIGN(const planet::ChunkFile other, planet::ChunkFile::open(file));
    const planet::PlanetShape& a = chunks.info().shape;
    const planet::PlanetShape& b = other.info().shape;
    const double slackM = 2 * std::max(fileQuantumM(a), fileQuantumM(b));
    const auto differs = [&](std::int32_t one, std::int32_t two) {
        return std::abs(planet::heightM(a, one) - planet::heightM(b, two)) > slackM;
    };
    if (a.radiusM == b.radiusM && planet::faceCells(a) == planet::faceCells(b) &&
        !differs(chunks.info().minStep, other.info().minStep) &&
        !differs(chunks.info().maxStep, other.info().maxStep))
        return {};
    return planet::badInput(fmt::format(
        "{}: is not a bake of the same planet; expected the options for its source with which it was baked",
        file.string()));
}

Result<void> bakeMissing(const SuggestRequest& request, SuggestClock& clock) {
    if (request.bakes.files.empty()) return {};
    clock.enter(SuggestStage::Baking);
    for (const SweptFile& file : request.bakes.files) {
        clock.beginBake(file.chunkSize);
        TRY(bakeSwept(request.bakes, file, request.sourceSettings, [&](const planet::BakeProgress& progress) {
            return clock.goOn(static_cast<double>(progress.samplesDone) /
                              static_cast<double>(std::max<std::uint64_t>(progress.samplesTotal, 1)));
        }));
    }
    return {};
}

// The measurements of the search, and those of its whole candidates.
class SuggestMeasurer {
public:
    SuggestMeasurer(const std::vector<MeteredFile>& files, const SuggestRequest& request, SuggestClock& clock)
        : files_(files), request_(request), clock_(clock) {}

    Result<SuggestFigures> measure(const SuggestCandidate& candidate, SuggestScope scope) {
        clock_.begin(candidate, scope);
        TRY_ASSIGN(SuggestMeasured measured, meterOf(candidate).measure(candidate, scope, [&](double share) {
            return clock_.goOn(share);
        }));
        clock_.end();
        const SuggestFigures figures = measured.figures;
        if (scope == SuggestScope::Whole) wholes_.emplace_back(candidate, std::move(measured));
        return figures;
    }

    const SuggestMeasured* measuredOf(const SuggestCandidate& candidate) const {
        const auto found =
            std::ranges::find_if(wholes_, [&](const auto& one) { return one.first == candidate; });
        return found == wholes_.end() ? nullptr : &found->second;
    }

    std::vector<SuggestPlan> plans(const SuggestCandidate& candidate) {
        const SuggestMeasured* const measured = measuredOf(candidate);
        if (!measured || !request_.vary.regions) return {};
        const auto binds = bindingLimit(costsOf(request_.budget), measured->figures.values);
        if (!binds) return {};
        std::vector<std::vector<SuggestGround>> frames;
        for (const SuggestWorst& worst : measured->worst[static_cast<std::size_t>(*binds)]) {
            // Frames far below the limit cost as much as the rest of the planet.
            if (worst.value < 0.8 * *request_.budget[*binds]) continue;
            auto ground = meterOf(candidate).groundIn(candidate, worst.view);
            if (ground) frames.push_back(std::move(*ground));
        }
        const std::vector<planet::Region> taken = request_.view.regions.all();
        return plansOver(frames, meterOf(candidate).planet().tree().shape.radiusM, taken);
    }

private:
    static SuggestBudget costsOf(SuggestBudget budget) {
        budget[SuggestLimit::ErrorPx].reset();
        return budget;
    }

    SuggestMeter& meterOf(const SuggestCandidate& candidate) const {
        return *std::ranges::find(files_, candidate.chunkSize, &MeteredFile::chunkSize)->meter;
    }

    const std::vector<MeteredFile>& files_;
    const SuggestRequest& request_;
    SuggestClock& clock_;
    std::vector<std::pair<SuggestCandidate, SuggestMeasured>> wholes_;
};

// Reads back what would be written, and says what it changes.
Result<void> readBack(const SuggestRequest& request, const ViewSettings& suggested, SuggestOutcome& outcome) {
    outcome.presetText = suggestPresetText(suggested);
    const std::string place =
        request.presetFile.empty() ? "the suggested preset" : request.presetFile.string();
    TRY_ASSIGN(const ViewPart part, viewPartFromText(outcome.presetText, place));
    outcome.settings = applied(part, request.view);
    outcome.settings.regions = request.view.regions;
    if (!outcome.found.best.candidate.regions.empty()) {
        outcome.regionsText = regionsText(suggested.regions.applied());
        TRY_ASSIGN(std::vector<planet::Region> regions,
                   regionsFromText(outcome.regionsText, request.regionsFile));
        outcome.settings.regions.list =
            std::make_shared<const std::vector<planet::Region>>(std::move(regions));
        outcome.settings.regions.file = request.regionsFile.string();
        outcome.settings.regions.on = true;
    }
    Settings before, after;
    before.view = request.view;
    after.view = outcome.settings;
    outcome.changes = differences(before, after);
    return {};
}

std::string showLine(const SuggestRequest& request, const SuggestOutcome& outcome,
                     const planet::CameraPose& pose) {
    std::string line =
        fmt::format("worldy shot {} -o shot.png --camera={} --size {}x{}", absoluteWord(outcome.file),
                    cameraText(roundedPose(pose)), request.size.widthPx, request.size.heightPx);
    if (!request.presetFile.empty()) line += " --settings " + absoluteWord(request.presetFile);
    if (!outcome.settings.regions.file.empty())
        line += " --regions " + absoluteWord(outcome.settings.regions.file);
    return line;
}

std::vector<SuggestPlace> placesOf(const SuggestRequest& request, const std::vector<SuggestLeg>& legs,
                                   const SuggestOutcome& outcome) {
    std::vector<SuggestPlace> places;
    const auto add = [&](SuggestLimit limit) {
        const auto& worst = outcome.measured.worst[static_cast<std::size_t>(limit)];
        for (std::size_t i = 0; i < std::min(worst.size(), request.worst); ++i) {
            const planet::CameraPose pose = planet::poseFromView(worst[i].view, outcome.radiusM);
            places.push_back(
                {limit, worst[i].value, legs[worst[i].leg].name, pose, showLine(request, outcome, pose), {}});
        }
    };
    // The places with the largest error come first, then those that cost most.
    add(SuggestLimit::ErrorPx);
    SuggestBudget costs = request.budget;
    costs[SuggestLimit::ErrorPx].reset();
    if (const auto binds = bindingLimit(costs, outcome.measured.figures.values)) add(*binds);
    return places;
}

// Draws frames with settings: views of all legs, and those that a measurement says to take longest. Without OpenGL, there
// are none.
Result<std::vector<TimedFrame>> drawnFramesOf(const SuggestRequest& request, const fs::path& file,
                                              const ViewSettings& measuredSettings,
                                              const SuggestMeasured& measured,
                                              const std::vector<SuggestLeg>& legs, SuggestClock& clock) {
    std::vector<TimedFrame> frames;
    const ViewSettings settings = drawnSettings(measuredSettings);
    Result<Offscreen> offscreen = openDrawn(request, file, settings);
    if (!offscreen) return frames;
    std::vector<planet::View> views = spreadViews(legs, 4);
    for (const SuggestWorst& worst : measured.worst[frameMsIndex]) views.push_back(worst.view);
    const std::function<bool()> goOn = [&] {
        return clock.goOn(static_cast<double>(frames.size()) / static_cast<double>(views.size()));
    };
    for (const planet::View& view : views) {
        TRY_ASSIGN(const TimedFrame frame, timeFrame(*offscreen, view, settings, goOn));
        frames.push_back(frame);
    }
    return frames;
}

void raiseFrameTime(SuggestMeasured& measured, const std::vector<TimedFrame>& frames) {
    double& ms = measured.figures.values[frameMsIndex];
    for (const TimedFrame& frame : frames) ms = std::max(ms, frame.ms);
}

// Times frames with the settings before and the suggested ones, if those have a budget that was measured here. Both or
// neither, because a fitted time and a drawn one do not compare.
Result<void> timeBoth(const SuggestRequest& request, const std::vector<SuggestLeg>& legs, SuggestClock& clock,
                      SuggestOutcome& outcome) {
    if (!request.budget[SuggestLimit::FrameMs] || !outcome.cost || !outcome.cost->isMeasured) return {};
    clock.enter(SuggestStage::Drawing);
    TRY_ASSIGN(std::vector<TimedFrame> before,
               drawnFramesOf(request, request.file, outcome.before, outcome.beforeMeasured, legs, clock));
    std::vector<TimedFrame> after = before;
    if (!keepsSettings(outcome)) {
        TRY_ASSIGN(after,
                   drawnFramesOf(request, outcome.file, outcome.settings, outcome.measured, legs, clock));
    }
    if (before.empty() || after.empty()) return {};
    raiseFrameTime(outcome.beforeMeasured, before);
    raiseFrameTime(outcome.measured, after);
    outcome.drawnBefore = std::move(before);
    outcome.drawnFrames = std::move(after);
    return {};
}

// Suggests the settings of now, as they were measured.
Result<void> keepNow(const SuggestRequest& request, const std::optional<FrameCost>& cost,
                     SuggestOutcome& outcome) {
    outcome.found.best = outcome.found.before;
    outcome.measured = outcome.beforeMeasured;
    outcome.drawnFrames = outcome.drawnBefore;
    outcome.file = request.file;
    outcome.cost = cost;
    outcome.regionsText.clear();
    return readBack(request, outcome.before, outcome);
}

// Draws the places. Without OpenGL, there are no pictures.
Result<void> draw(const SuggestRequest& request, SuggestClock& clock, SuggestOutcome& outcome) {
    if (!request.drawsPictures) {
        outcome.noPictures = "Pictures were not asked for.";
        return {};
    }
    clock.enter(SuggestStage::Drawing);
    const ViewSettings settings = drawnSettings(outcome.settings);
    Result<Offscreen> offscreen = openDrawn(request, outcome.file, settings);
    if (!offscreen) {
        outcome.noPictures =
            fmt::format("There are no pictures, because OpenGL is not there: {}.", offscreen.error().message);
        return {};
    }
    const auto total = static_cast<double>(outcome.places.size());
    std::size_t done = 0;
    const std::function<bool()> goOn = [&] { return clock.goOn(static_cast<double>(done) / total); };
    for (SuggestPlace& place : outcome.places) {
        if (!goOn()) return planet::cancelled();
        const SettledView at = settleAt(*offscreen, place.pose, settings, goOn);
        if (!at.settled && !goOn()) return planet::cancelled();
        TRY(drawAndFinish(*offscreen, at.view, settings));
        place.picture = readPicture(*offscreen);
        ++done;
    }
    return {};
}

}  // namespace

void nameSuggestFiles(SuggestRequest& request, const fs::path& preset, const fs::path& regions,
                      SuggestOutcome& outcome) {
    request.presetFile = preset;
    request.regionsFile = regions;
    if (!outcome.regionsText.empty()) outcome.settings.regions.file = regions.string();
    for (SuggestPlace& place : outcome.places) place.line = showLine(request, outcome, place.pose);
}

bool keepsSettings(const SuggestOutcome& outcome) {
    return outcome.found.best.candidate == outcome.found.before.candidate;
}

bool isNoBetter(const SuggestOutcome& outcome) {
    const SuggestFigures& found = outcome.measured.figures;
    return mostUse(outcome.budget, found.values) > 1 &&
           !isBetter(outcome.budget, found, outcome.beforeMeasured.figures);
}

std::string suggestPresetText(const ViewSettings& settings) {
    constexpr std::array<std::string_view, 5> tables = {"lod", "budget", "seams", "paging", "bad_disk"};
    constexpr std::array<std::string_view, 8> names = {
        "view.fov_deg", "surface.exaggeration", "surface.streamed", "surface.texels_per_pixel",
        "surface.sea",  "surface.sea_level_m",  "light.sea",        "light.normals"};
    ViewSettings copy = settings;
    std::vector<Field> kept;
    for (const Field& field : fieldsOf(copy)) {
        if (std::ranges::find(tables, field.table) != tables.end() ||
            std::ranges::find(names, field.name()) != names.end())
            kept.push_back(field);
    }
    return "# Settings that worldy suggest has found and measured; keys not listed keep their values.\n" +
           fieldsText(kept);
}

Result<SuggestOutcome> runSuggest(const SuggestRequest& request, const SuggestWatcher& watcher) {
    const Stopwatch elapsed;
    SuggestClock clock(watcher);

    // 1. Open the planet, and collect what to measure.
    if (request.budget.isEmpty()) return planet::badInput("there is no budget; expected at least one");
    TRY_ASSIGN(const planet::ChunkFile chunks, planet::ChunkFile::open(request.file));
    TRY_ASSIGN(const std::vector<SuggestLeg> legs, legsOf(request, chunks, clock));

    // 2. Find what a frame takes here.
    SuggestOutcome outcome;
    outcome.budget = request.budget;
    outcome.size = request.size;
    outcome.hasRecordings = std::ranges::any_of(legs, &SuggestLeg::isRecorded);
    TRY(bakeMissing(request, clock));
    std::vector<MeteredFile> files;
    const auto add = [&](int chunkSize, const fs::path& file) -> Result<void> {
        TRY(checkSamePlanet(chunks, file));
        TRY_ASSIGN(MeteredFile metered, meteredFile(request, chunkSize, file, legs, clock));
        files.push_back(std::move(metered));
        return {};
    };
    TRY(add(0, request.file));
    for (const SweptFile& bake : request.bakes.files) TRY(add(bake.chunkSize, bake.chunkFile));

    // 3. Search.
    clock.enter(SuggestStage::Searching);
    const SuggestCandidate now = candidateOf(request.view);
    outcome.before = settingsWith(request.view, now);
    outcome.radiusM = chunks.info().shape.radiusM;
    SuggestMeasurer measurer(files, request, clock);
    const SuggestCalls calls{
        .measure = [&](const SuggestCandidate& candidate,
                       SuggestScope scope) { return measurer.measure(candidate, scope); },
        .plans = [&](const SuggestCandidate& candidate) { return measurer.plans(candidate); },
        .tried =
            [&](const SuggestTrial& trial) {
                if (watcher.tried) watcher.tried(trial);
            },
        .ahead = [&](std::size_t samples, std::size_t wholes) { clock.setAhead(samples, wholes); }};
    TRY_ASSIGN(outcome.found, searchSuggestion(request.budget, now, rangesOf(request), calls));
    if (const SuggestMeasured* before = measurer.measuredOf(now)) outcome.beforeMeasured = *before;

    // 4. Read back what would be written, and measure that.
    clock.enter(SuggestStage::Verifying);
    TRY(readBack(request, settingsWith(request.view, outcome.found.best.candidate), outcome));
    const MeteredFile& best =
        *std::ranges::find(files, outcome.found.best.candidate.chunkSize, &MeteredFile::chunkSize);
    outcome.file = best.file;
    outcome.cost = best.cost;
    TRY_ASSIGN(auto reopened,
               planet::Planet::open(
                   best.file, pagingSettingsOf(outcome.settings, false, planet::PagingTime::Simulated)));
    SuggestMeter again(std::move(reopened), outcome.settings, legs, best.cost);
    TRY_ASSIGN(outcome.measured, again.measure(candidateOf(outcome.settings), SuggestScope::Whole,
                                               [&](double share) { return clock.goOn(share); }));
    for (const SuggestLeg& leg : legs) {
        outcome.legs.push_back(leg.name);
        outcome.frames.push_back(leg.frames.size());
    }

    // 5. Compare frames that are drawn, and keep the settings of now unless what was found is better by them too.
    TRY(timeBoth(request, legs, clock, outcome));
    if (!keepsSettings(outcome) && isNoBetter(outcome)) TRY(keepNow(request, files.front().cost, outcome));
    outcome.isMet = mostUse(outcome.budget, outcome.measured.figures.values) <= 1;

    // 6. Look at the worst places.
    outcome.places = placesOf(request, legs, outcome);
    TRY(draw(request, clock, outcome));
    outcome.elapsedS = elapsed.elapsedMs() / 1000;
    return outcome;
}

}  // namespace worldy
