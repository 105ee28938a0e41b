#include "app/cli/atlas_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <glm/trigonometric.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "app/base/interrupt.h"
#include "app/base/message.h"
#include "app/base/output_file.h"
#include "app/base/report.h"
#include "app/base/text.h"
#include "app/data/bake_progress.h"
#include "app/measure/atlas_survey.h"
#include "app/measure/atlas_table.h"
#include "app/settings/settings.h"
#include "app/settings/settings_text.h"
#include "planet/base/result.h"
#include "planet/base/try.h"
#include "planet/measure/atlas.h"
#include "planet/measure/atlas_diff.h"
#include "planet/measure/atlas_file.h"
#include "planet/measure/atlas_run.h"
#include "planet/measure/atlas_tree.h"
#include "planet/sphere/cube_sphere.h"

namespace worldy {

namespace {

using Json = nlohmann::ordered_json;
using planet::Result;

// Returns the settings of the earlier atlas, changed by the command line. Regions are those of now, because they belong
// to the planet.
Result<ViewSettings> settingsForDiff(const AtlasOptions& options, const planet::Atlas& old) {
    if (!options.changes.settingsFile.empty()) return options.view;
    TRY_ASSIGN(ViewSettings view, settingsOf(old.survey, options.diff.string()));
    Settings settings;
    settings.view = std::move(view);
    for (const auto* assignments : {&options.changes.options, &options.changes.assignments}) {
        for (const std::string& assignment : *assignments) TRY(setSetting(settings, assignment));
    }
    const bool usesRegions = options.view.regions.on;
    settings.view.regions = options.view.regions;
    settings.view.regions.on = usesRegions;
    return settings.view;
}

void setDisk(const AtlasOptions& options, bool isDiff, ViewSettings& view) {
    planet::BadDiskSettings& disk = view.paging.badDisk;
    if (!isDiff) setUsualDisk(disk);
    disk.latencyMs = options.diskMs.value_or(disk.latencyMs);
    disk.bandwidthMBs = options.diskMBs.value_or(disk.bandwidthMBs);
}

Result<AtlasRequest> requestOf(const AtlasOptions& options) {
    AtlasRequest request;
    request.file = options.file;
    request.output = options.output;
    request.view = options.view;
    request.size = options.size;
    request.grid = options.grid;
    request.measuresError = options.measuresError;
    request.recordsTree = options.recordsTree;
    request.resumes = options.resumes;
    request.threads = static_cast<std::size_t>(options.threads);
    if (request.threads == 0) request.threads = std::max(std::thread::hardware_concurrency(), 1u);
    if (!options.diff.empty()) {
        TRY_ASSIGN(planet::Atlas old, planet::loadAtlas(options.diff));
        if (!old.isFinished)
            return planet::badInput(
                fmt::format("{}: is not finished; expected a finished survey", options.diff.string()));
        TRY_ASSIGN(request.view, settingsForDiff(options, old));
        request.measuresError = options.measuresError || old.survey.measuresError;
        request.revisited = std::make_shared<const planet::Atlas>(std::move(old));
    }
    setDisk(options, !options.diff.empty(), request.view);
    return request;
}

void printSpreads(const planet::Atlas& atlas) {
    fmt::print("\n{:<26}{:>12}{:>12}{:>12}{:>12}  {}\n", "measure", "median", "P90", "P99", "maximum",
               "where");
    for (const AtlasSpread& one : spreadsOf(atlas.viewpoints)) {
        const std::size_t worst = worstViewpoints(atlas.viewpoints, one.measure, 1).front();
        fmt::print("{:<26}{:>12}{:>12}{:>12}{:>12}  {}\n", planet::textOf(one.measure).key,
                   figureText(one.measure, one.median), figureText(one.measure, one.p90),
                   figureText(one.measure, one.p99), figureText(one.measure, one.most),
                   viewpointText(atlas.survey, atlas.viewpoints[worst]));
    }
    for (const AtlasSpread& one : spreadsOf(atlas.viewpoints)) {
        if (one.unbounded == 0) continue;
        fmt::print(
            "{} has no bound at {} of {} viewpoints, where \u03b4c is at least the distance to a chunk\n",
            planet::textOf(one.measure).key, one.unbounded, one.count);
    }
}

void printWorst(const planet::Atlas& atlas, std::size_t worst) {
    for (const AtlasSpread& one : spreadsOf(atlas.viewpoints)) {
        if (one.most == 0 || worst == 0) continue;
        fmt::print("\nworst {}\n", planet::textOf(one.measure).key);
        for (const std::size_t i : worstViewpoints(atlas.viewpoints, one.measure, worst)) {
            const planet::AtlasViewpoint& viewpoint = atlas.viewpoints[i];
            fmt::print("{:>14}  {}\n",
                       figureText(one.measure, planet::figureOf(viewpoint.figures, one.measure)),
                       viewpointText(atlas.survey, viewpoint));
        }
    }
}

void printCosts(const AtlasOutcome& outcome) {
    const planet::AtlasRun& run = outcome.run;
    if (outcome.treeS > 0)
        fmt::print("tree: {} chunks listed in {:.2f} s\n", outcome.atlas.tree.chunks.size(), outcome.treeS);
    if (run.measured == 0) return;
    const auto count = static_cast<double>(run.measured);
    fmt::print(
        "{} viewpoints in {}, {:.1f} per second on {} threads; ms per viewpoint: ground {:.2f}, settle "
        "{:.2f}, "
        "true error {:.2f}, move {:.2f}\n",
        run.measured, durationText(run.elapsedS), count / run.elapsedS, run.threads,
        1000 * run.costs.groundS / count, 1000 * run.costs.settleS / count, 1000 * run.costs.errorS / count,
        1000 * run.costs.moveS / count);
}

void printMoves(const planet::AtlasMeasureDiff& diff, const planet::Atlas& now, std::size_t worst) {
    const auto print = [&](const planet::AtlasMove& move) {
        fmt::print("  {:>12} > {:<12} {}\n", figureText(diff.measure, move.before),
                   figureText(diff.measure, move.now),
                   viewpointText(now.survey, now.viewpoints[move.viewpoint]));
    };
    fmt::print("{}: {} of {} viewpoints grew, {} shrank\n", planet::textOf(diff.measure).key, diff.grew,
               diff.compared, diff.shrank);
    for (std::size_t i = 0; i < std::min(diff.grew, worst); ++i) print(diff.moves[i]);
    for (std::size_t i = 0; i < std::min(diff.shrank, worst); ++i)
        print(diff.moves[diff.moves.size() - 1 - i]);
}

void printTrees(const AtlasDiff& diff, std::size_t worst) {
    if (!diff.comparesTrees) {
        fmt::print("trees: not compared, because an atlas has none\n");
        return;
    }
    fmt::print("trees: {} listed chunks changed\n", diff.chunks.size());
    for (std::size_t i = 0; i < std::min(diff.areas.size(), worst); ++i) {
        const planet::AtlasChangedArea& area = diff.areas[i];
        const planet::Geographic place = planet::geographicFromDirection(planet::middleOf(area.cell));
        std::string counts;
        for (std::size_t kind = 0; kind < planet::atlasChangeCount; ++kind) {
            if (area.chunks[kind] > 0)
                counts += fmt::format(", {} {}", area.chunks[kind], planet::atlasChangeNames[kind]);
        }
        fmt::print("  {}, {}{}; \u03b4c x {:.3g} to {:.3g}\n",
                   placeText(glm::degrees(place.latitudeRad), glm::degrees(place.longitudeRad)),
                   planet::toString(area.cell), counts, area.leastRatio, area.mostRatio);
    }
}

void printVerdicts(const AtlasDiff& diff, const planet::Atlas& now, std::size_t worst) {
    for (const AtlasVerdict& verdict : diff.verdicts) {
        fmt::print("limit {}: {}\n", planet::textOf(verdict.limit),
                   verdict.isMet ? std::string("met")
                   : verdict.exceeded.empty()
                       ? std::string("exceeded")
                       : fmt::format("exceeded in {} viewpoints", verdict.exceeded.size()));
        for (std::size_t i = 0; i < std::min(verdict.exceeded.size(), worst); ++i) {
            const planet::AtlasMove& move = verdict.exceeded[i];
            fmt::print("  {:>12} > {:<12} {}\n", figureText(*verdict.limit.measure, move.before),
                       figureText(*verdict.limit.measure, move.now),
                       viewpointText(now.survey, now.viewpoints[move.viewpoint]));
        }
    }
}

// Says which settings the two surveys do not share.
Json differentSettings(const planet::Atlas& before, const planet::Atlas& now, bool prints) {
    Json list = Json::array();
    for (const SettingDifference& one : differencesOf(before.survey, now.survey)) {
        if (prints) fmt::print("{}: {} before, {} now\n", one.setting, one.here, one.there);
        list.push_back({{"setting", one.setting}, {"before", one.here}, {"now", one.there}});
    }
    return list;
}

Result<AtlasOutcome> surveyOnTerminal(const AtlasRequest& request) {
    const InterruptWatch watch;
    std::optional<TerminalProgress> line(std::in_place);
    return surveyAtlas(request, [&](const std::optional<planet::AtlasProgress>& progress) {
        if (progress) line->show(*progress);
        return !watch.interrupted();
    });
}

// There is nothing to continue in a survey that is finished. An empty file only reserves its name.
Result<void> checkUnfinished(const AtlasOptions& options) {
    std::error_code status;
    const std::filesystem::path unfinished = planet::unfinishedAtlas(options.output);
    const std::uintmax_t bytes = std::filesystem::file_size(options.output, status);
    const bool isFinished =
        options.resumes && !status && bytes > 0 && !std::filesystem::exists(unfinished, status);
    if (!isFinished) return {};
    return planet::badInput(fmt::format("{}: is finished; expected an unfinished survey, {}",
                                        options.output.string(), unfinished.string()));
}

Result<bool> report(const AtlasOptions& options, const AtlasRequest& request, const AtlasOutcome& outcome) {
    const planet::Atlas& atlas = outcome.atlas;
    const std::size_t worst = options.listed;
    if (!options.json) {
        printCosts(outcome);
        printSpreads(atlas);
        if (!request.revisited) printWorst(atlas, worst);
    }
    if (!options.csv.empty()) TRY(writeTextFile(options.csv, atlasCsv(atlas)));
    Json json = atlasJson(atlas, outcome.run, outcome.treeS);
    bool isGood = true;
    if (request.revisited) {
        TRY_ASSIGN(const AtlasDiff diff, diffOf(*request.revisited, atlas, options.limits));
        if (!options.json) fmt::print("\ncompared with {}\n", options.diff.string());
        Json settings = differentSettings(*request.revisited, atlas, !options.json);
        if (!options.json) {
            for (const planet::AtlasMeasureDiff& one : diff.measures) printMoves(one, atlas, worst);
            printTrees(diff, worst);
            printVerdicts(diff, atlas, worst);
        }
        json["diff"] = diffJson(diff, atlas, worst);
        json["diff"]["settings"] = std::move(settings);
        isGood = diff.isWithinLimits();
    }
    if (options.json) fmt::print("{}", jsonText(json));
    return isGood;
}

}  // namespace

Result<bool> runAtlasCommand(const AtlasOptions& options) {
    TRY(checkUnfinished(options));
    TRY_ASSIGN(const AtlasRequest request, requestOf(options));
    Result<AtlasOutcome> outcome = surveyOnTerminal(request);
    if (!outcome && outcome.error().kind == planet::ErrorKind::Cancelled && !options.output.empty())
        printMessage("{} holds what was surveyed; --resume continues it\n",
                     planet::unfinishedAtlas(options.output).string());
    if (!outcome) return tl::unexpected(std::move(outcome).error());
    return report(options, request, *outcome);
}

}  // namespace worldy
