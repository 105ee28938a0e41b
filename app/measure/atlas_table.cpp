#include "app/measure/atlas_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/trigonometric.hpp>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "app/base/report.h"
#include "app/base/text.h"
#include "planet/base/percentile.h"
#include "planet/base/result.h"
#include "planet/base/try.h"
#include "planet/measure/atlas.h"
#include "planet/measure/atlas_diff.h"
#include "planet/measure/atlas_run.h"
#include "planet/measure/atlas_tree.h"
#include "planet/sphere/chunk_id.h"
#include "planet/sphere/cube_sphere.h"
#include "planet/sphere/view.h"

namespace worldy {

namespace {

using AtlasJson = nlohmann::ordered_json;
using planet::AtlasMeasure;
using planet::AtlasViewpoint;
using planet::Result;

constexpr int areaLevel = 5;  // areas of changed chunks are at least this small, 310 km on Earth

// JSON has no infinity.
AtlasJson numberOrNull(double value) {
    return std::isfinite(value) ? AtlasJson(value) : AtlasJson(nullptr);
}

AtlasJson jsonOf(const planet::AtlasSurvey& survey, const AtlasViewpoint& viewpoint) {
    const planet::CameraPose pose = planet::poseOf(survey, viewpoint);
    return {{"cell", planet::toString(viewpoint.place.cell)},
            {"latitude_deg", pose.latitudeDeg},
            {"longitude_deg", pose.longitudeDeg},
            {"above_ground_m", survey.grid.altitudesM[viewpoint.place.altitude]},
            {"camera_altitude_m", pose.altitudeM},
            {"heading_deg", pose.headingDeg},
            {"pitch_deg", pose.pitchDeg}};
}

AtlasJson jsonOf(const AtlasSpread& spread) {
    return {{"measure", planet::textOf(spread.measure).key},
            {"viewpoints", spread.count},
            {"unbounded", spread.unbounded},
            {"median", numberOrNull(spread.median)},
            {"p90", numberOrNull(spread.p90)},
            {"p99", numberOrNull(spread.p99)},
            {"maximum", numberOrNull(spread.most)}};
}

AtlasJson jsonOf(const planet::AtlasMove& move, const planet::Atlas& atlas) {
    AtlasJson json = jsonOf(atlas.survey, atlas.viewpoints[move.viewpoint]);
    // A move has both figures, so null is no bound.
    json["before"] = numberOrNull(move.before);
    json["now"] = numberOrNull(move.now);
    return json;
}

template <class Range>
AtlasJson movesJson(const Range& moves, const planet::Atlas& atlas, std::size_t worst) {
    AtlasJson list = AtlasJson::array();
    for (const planet::AtlasMove& move : moves) {
        if (list.size() >= worst) break;
        list.push_back(jsonOf(move, atlas));
    }
    return list;
}

AtlasJson jsonOf(const planet::AtlasChangedArea& area) {
    const planet::Geographic place = planet::geographicFromDirection(planet::middleOf(area.cell));
    AtlasJson json = {{"cell", planet::toString(area.cell)},
                      {"latitude_deg", glm::degrees(place.latitudeRad)},
                      {"longitude_deg", glm::degrees(place.longitudeRad)}};
    for (std::size_t i = 0; i < planet::atlasChangeCount; ++i)
        json[fmt::format("chunks_{}", planet::atlasChangeNames[i])] = area.chunks[i];
    json["least_error_ratio"] = area.leastRatio;
    json["most_error_ratio"] = area.mostRatio;
    return json;
}

// Returns whether any viewpoint has a measure.
bool hasMeasure(const planet::Atlas& atlas, AtlasMeasure measure) {
    return std::any_of(atlas.viewpoints.begin(), atlas.viewpoints.end(), [&](const AtlasViewpoint& one) {
        return !std::isnan(planet::figureOf(one.figures, measure));
    });
}

// A view that is not sharp in time has no time until it is, so no limit on that can be told to be met.
Result<void> checkAllSharp(const planet::AtlasLimit& limit, const planet::Atlas& before,
                           const planet::Atlas& now) {
    for (const auto& [atlas, name] : {std::pair(&before, "earlier"), std::pair(&now, "present")}) {
        const auto unsharp = std::ranges::count_if(atlas->viewpoints, [](const AtlasViewpoint& one) {
            return std::isnan(planet::figureOf(one.figures, AtlasMeasure::SharpS));
        });
        if (unsharp == 0) continue;
        return planet::badInput(fmt::format(
            "{}: {} of {} viewpoints of the {} survey are not sharp within {:g} s; expected a faster disk",
            planet::textOf(limit), unsharp, atlas->viewpoints.size(), name, planet::atlasTimeoutS));
    }
    return {};
}

Result<AtlasVerdict> verdictOf(const planet::AtlasLimit& limit, const AtlasDiff& diff,
                               const planet::Atlas& before, const planet::Atlas& now) {
    AtlasVerdict verdict{limit, {}, true};
    if (!limit.measure) {
        if (!diff.comparesTrees)
            return planet::badInput(fmt::format(
                "{}: an atlas without a tree cannot tell; expected two with one", planet::textOf(limit)));
        verdict.isMet = !planet::isExceeded(limit, 0, static_cast<double>(diff.chunks.size()));
        return verdict;
    }
    const bool needsSharpViews =
        limit.measure == AtlasMeasure::SharpS || limit.measure == AtlasMeasure::BytesRead;
    if (needsSharpViews) TRY(checkAllSharp(limit, before, now));
    if (!hasMeasure(before, *limit.measure) || !hasMeasure(now, *limit.measure)) {
        return planet::badInput(fmt::format(
            "{}: is not measured in both surveys; expected both with --true-error", planet::textOf(limit)));
    }
    for (const planet::AtlasMeasureDiff& one : diff.measures) {
        if (one.measure != *limit.measure) continue;
        std::copy_if(
            one.moves.begin(), one.moves.end(), std::back_inserter(verdict.exceeded),
            [&](const planet::AtlasMove& move) { return planet::isExceeded(limit, move.before, move.now); });
    }
    if (limit.isDown) std::reverse(verdict.exceeded.begin(), verdict.exceeded.end());
    verdict.isMet = verdict.exceeded.empty();
    return verdict;
}

}  // namespace

std::vector<AtlasSpread> spreadsOf(std::span<const AtlasViewpoint> viewpoints) {
    std::vector<AtlasSpread> spreads;
    for (std::size_t i = 0; i < planet::atlasMeasureCount; ++i) {
        std::vector<double> values;
        for (const AtlasViewpoint& viewpoint : viewpoints) {
            if (!std::isnan(viewpoint.figures[i])) values.push_back(viewpoint.figures[i]);
        }
        if (values.empty()) continue;
        const auto unbounded =
            static_cast<std::size_t>(std::ranges::count(values, std::numeric_limits<double>::infinity()));
        spreads.push_back({static_cast<AtlasMeasure>(i), values.size(), unbounded,
                           planet::percentileOf(values, 0.5), planet::percentileOf(values, 0.9),
                           planet::percentileOf(values, 0.99), planet::percentileOf(values, 1)});
    }
    return spreads;
}

std::vector<std::size_t> worstViewpoints(std::span<const AtlasViewpoint> viewpoints, AtlasMeasure measure,
                                         std::size_t count) {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < viewpoints.size(); ++i) {
        if (!std::isnan(planet::figureOf(viewpoints[i].figures, measure))) order.push_back(i);
    }
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return planet::figureOf(viewpoints[a].figures, measure) >
               planet::figureOf(viewpoints[b].figures, measure);
    });
    std::set<std::pair<planet::ChunkId, int>> seen;
    std::vector<std::size_t> worst;
    for (const std::size_t i : order) {
        if (worst.size() >= count) break;
        const planet::AtlasPlace& place = viewpoints[i].place;
        if (seen.emplace(place.cell, place.altitude).second) worst.push_back(i);
    }
    return worst;
}

std::string figureText(AtlasMeasure measure, double value) {
    if (std::isnan(value)) return "-";
    if (std::isinf(value)) return "no bound";
    switch (measure) {
        case AtlasMeasure::BytesRead:
            return bytesText(value);
        case AtlasMeasure::Triangles:
            return countText(value);
        case AtlasMeasure::Thrashes:
            return fmt::format("{:.0f}", value);
        case AtlasMeasure::SharpS:
            return fmt::format("{:.3g} s", value);
        default:
            return fmt::format("{:.3g} px", value);
    }
}

std::string changeText(AtlasMeasure measure, double by) {
    if (std::isnan(by)) return "-";
    if (std::isinf(by)) return by > 0 ? "bound lost" : "bound gained";
    if (by == 0) return "0";
    return (by > 0 ? "+" : "-") + figureText(measure, std::abs(by));
}

std::string viewpointText(const planet::AtlasSurvey& survey, const AtlasViewpoint& viewpoint) {
    const planet::CameraPose pose = planet::poseOf(survey, viewpoint);
    return fmt::format("{:.2f}\u00b0 {} {:.2f}\u00b0 {}, {}, {:.0f}\u00b0", std::abs(pose.latitudeDeg),
                       pose.latitudeDeg < 0 ? 'S' : 'N', std::abs(pose.longitudeDeg),
                       pose.longitudeDeg < 0 ? 'W' : 'E',
                       distanceText(survey.grid.altitudesM[viewpoint.place.altitude]), pose.headingDeg);
}

std::string atlasCsv(const planet::Atlas& atlas) {
    std::string text =
        "schema_version,cell,latitude_deg,longitude_deg,above_ground_m,camera_altitude_m,heading_deg,pitch_"
        "deg";
    for (const planet::AtlasMeasureText& measure : planet::atlasMeasureTexts)
        text += fmt::format(",{}", measure.key);
    for (const AtlasViewpoint& viewpoint : atlas.viewpoints) {
        const planet::CameraPose pose = planet::poseOf(atlas.survey, viewpoint);
        text += fmt::format("\n{},{},{},{},{},{},{},{}", schemaVersion,
                            planet::toString(viewpoint.place.cell), pose.latitudeDeg, pose.longitudeDeg,
                            atlas.survey.grid.altitudesM[viewpoint.place.altitude], pose.altitudeM,
                            pose.headingDeg, pose.pitchDeg);
        for (const double figure : viewpoint.figures)
            text += std::isnan(figure) ? std::string(",") : fmt::format(",{}", figure);
    }
    return text + "\n";
}

AtlasJson atlasJson(const planet::Atlas& atlas, const planet::AtlasRun& run, double treeS) {
    const planet::AtlasSurvey& survey = atlas.survey;
    AtlasJson report = {{"bake", survey.bake},
                        {"width_px", survey.widthPx},
                        {"height_px", survey.heightPx},
                        {"fov_deg", survey.fovDeg},
                        {"altitudes_m", survey.grid.altitudesM},
                        {"headings", survey.grid.headings},
                        {"measures_error", survey.measuresError},
                        {"viewpoints_measured", run.measured},
                        {"elapsed_s", run.elapsedS},
                        {"threads", run.threads},
                        {"tree_chunks", atlas.tree.chunks.size()},
                        {"tree_s", treeS}};
    if (run.measured > 0) {
        report["viewpoints_per_s"] = static_cast<double>(run.measured) / run.elapsedS;
        report["ms_per_viewpoint"] = {};
        for (const auto& [name, seconds] :
             {std::pair{"ground", run.costs.groundS}, std::pair{"settle", run.costs.settleS},
              std::pair{"true_error", run.costs.errorS}, std::pair{"move", run.costs.moveS}})
            report["ms_per_viewpoint"][name] = 1000 * seconds / static_cast<double>(run.measured);
    }
    report["measures"] = AtlasJson::array();
    for (const AtlasSpread& spread : spreadsOf(atlas.viewpoints))
        report["measures"].push_back(jsonOf(spread));
    report["viewpoints"] = AtlasJson::array();
    for (const AtlasViewpoint& viewpoint : atlas.viewpoints) {
        AtlasJson json = jsonOf(survey, viewpoint);
        for (std::size_t i = 0; i < planet::atlasMeasureCount; ++i)
            json[std::string(planet::atlasMeasureTexts[i].key)] = numberOrNull(viewpoint.figures[i]);
        for (std::size_t i = 0; i < planet::atlasMeasureCount; ++i) {
            if (std::isinf(viewpoint.figures[i]))
                json["unbounded"].push_back(planet::atlasMeasureTexts[i].key);
        }
        report["viewpoints"].push_back(std::move(json));
    }
    return report;
}

bool AtlasDiff::isWithinLimits() const {
    return std::all_of(verdicts.begin(), verdicts.end(), [](const AtlasVerdict& one) { return one.isMet; });
}

Result<AtlasDiff> diffOf(const planet::Atlas& before, const planet::Atlas& now,
                         std::span<const planet::AtlasLimit> limits) {
    AtlasDiff diff;
    TRY_ASSIGN(diff.measures, planet::compareViewpoints(before.viewpoints, now.viewpoints));
    diff.comparesTrees = !before.tree.chunks.empty() && !now.tree.chunks.empty();
    if (diff.comparesTrees) diff.chunks = planet::changesBetween(before.tree, now.tree);
    diff.areas = planet::changedAreas(diff.chunks, areaLevel);
    for (const planet::AtlasLimit& limit : limits) {
        TRY_ASSIGN(AtlasVerdict verdict, verdictOf(limit, diff, before, now));
        diff.verdicts.push_back(std::move(verdict));
    }
    return diff;
}

AtlasJson diffJson(const AtlasDiff& diff, const planet::Atlas& now, std::size_t worst) {
    AtlasJson report = {{"within_limits", diff.isWithinLimits()}, {"limits", AtlasJson::array()}};
    for (const AtlasVerdict& verdict : diff.verdicts) {
        report["limits"].push_back({{"limit", planet::textOf(verdict.limit)},
                                    {"met", verdict.isMet},
                                    {"viewpoints", verdict.exceeded.size()},
                                    {"worst", movesJson(verdict.exceeded, now, worst)}});
    }
    report["measures"] = AtlasJson::array();
    for (const planet::AtlasMeasureDiff& one : diff.measures) {
        const std::span moves(one.moves);
        report["measures"].push_back({{"measure", planet::textOf(one.measure).key},
                                      {"compared", one.compared},
                                      {"grew", one.grew},
                                      {"shrank", one.shrank},
                                      {"largest_increases", movesJson(moves.first(one.grew), now, worst)}});
        AtlasJson& shrunk = report["measures"].back()["largest_decreases"] = AtlasJson::array();
        for (std::size_t i = 0; i < std::min(one.shrank, worst); ++i)
            shrunk.push_back(jsonOf(moves[moves.size() - 1 - i], now));
    }
    report["compares_trees"] = diff.comparesTrees;
    report["changed_chunks"] = diff.chunks.size();
    report["changed_areas"] = AtlasJson::array();
    for (std::size_t i = 0; i < std::min(diff.areas.size(), worst); ++i)
        report["changed_areas"].push_back(jsonOf(diff.areas[i]));
    return report;
}

}  // namespace worldy
