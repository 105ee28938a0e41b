#include "app/suggest/suggest_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "app/base/text.h"
#include "app/measure/sweep_points.h"
#include "app/scene/frame_report.h"
#include "app/settings/shot_line.h"
#include "app/suggest/suggest_budget.h"
#include "app/suggest/suggest_run.h"
#include "app/suggest/suggest_search.h"

namespace worldy {

namespace {

using Json = nlohmann::ordered_json;

double valueOfLimit(const SuggestFigures& figures, SuggestLimit limit) {
    return figures.values[static_cast<std::size_t>(limit)];
}

std::string verdictOf(const SuggestOutcome& outcome, SuggestLimit limit) {
    const std::optional<double>& budget = outcome.budget[limit];
    const double value = valueOfLimit(outcome.measured.figures, limit);
    if (!budget) return "no budget";
    if (std::isnan(value)) return "not measured";
    const bool isPredicted = limit == SuggestLimit::FrameMs && (!outcome.cost || !outcome.cost->isMeasured);
    const double over = value / *budget - 1;
    if (over <= 0) return isPredicted ? "predicted to be met" : "met";
    const char* const predicted = isPredicted ? "predicted to be " : "";
    if (over < 9.995) return fmt::format("{}exceeded by {:.3g} %", predicted, 100 * over);
    return fmt::format("{}exceeded {}-fold", predicted, countText(std::round(over + 1)));
}

std::string regionsNote(const SuggestOutcome& outcome) {
    const SuggestCandidate& best = outcome.found.best.candidate;
    if (best.regions.empty()) return "";
    const planet::Region& region = best.regions.front();
    std::string where =
        fmt::format("{} around the places that cost most", countedText(region.circles.size(), "circle"));
    if (region.heights)
        where = fmt::format("ground between {:.0f} and {:.0f} m", region.heights->lowestM,
                            region.heights->highestM);
    return fmt::format(
        " The region \"{}\" multiplies τ by {:g} in {}, so that τ can be smaller everywhere else.",
        region.name, region.tauFactor.value_or(1), where);
}

std::string needsText(const SuggestOutcome& outcome) {
    std::string text;
    const SuggestNeeds& needs = outcome.found.needs;
    const auto over = [&](const SuggestTrial& trial) {
        std::vector<std::string> parts;
        for (const SuggestLimit limit : suggestLimits) {
            const double value = valueOfLimit(trial.figures, limit);
            if (useOf(outcome.budget, limit, value) > 1) parts.push_back(limitText(limit, value));
        }
        return fmt::format("{}", fmt::join(parts, " and "));
    };
    if (outcome.budget.limitsCosts() && !needs.costsMet)
        text += fmt::format(" No τ up to {:g} px meets the budgets of costs.", largestTauPx);
    if (needs.costsMet)
        text += fmt::format(" At τ = {:.3g} px the costs would fit, but the budget would have to allow {}.",
                            needs.costsMet->candidate.tauPx, over(*needs.costsMet));
    if (needs.errorMet)
        text += fmt::format(" At τ = {:.3g} px the error would fit, but the budget would have to allow {}.",
                            needs.errorMet->candidate.tauPx, over(*needs.errorMet));
    return text;
}

// Returns the target of a Markdown link to a file beside the page.
std::string linkTarget(std::string_view name) {
    std::string target;
    for (const char letter : name) {
        const bool isPlain = std::string_view(" ()<>%#?\"").find(letter) == std::string_view::npos &&
                             static_cast<unsigned char>(letter) > ' ';
        target += isPlain ? std::string(1, letter)
                          : fmt::format("%{:02X}", static_cast<unsigned>(static_cast<unsigned char>(letter)));
    }
    return target;
}

// Returns the command that draws the planet with the suggestion. A report that is given no files names those beside it.
std::string drawLine(const SuggestOutcome& outcome, const SuggestRequest& request, const std::string& name) {
    const auto orBeside = [&](const std::filesystem::path& file, const char* ending) {
        return file.empty() ? pathWord(name + ending) : absoluteWord(file);
    };
    std::string line = fmt::format("worldy shot {} --settings {}", absoluteWord(outcome.file),
                                   orBeside(request.presetFile, ".toml"));
    if (!outcome.regionsText.empty()) line += " --regions " + orBeside(request.regionsFile, ".regions.toml");
    return line + " -o shot.png";
}

std::string unsettledText(const SuggestOutcome& outcome) {
    const std::size_t views = outcome.measured.figures.unsettled;
    if (views == 0) return "";
    return fmt::format(
        " {} not loaded within {:g} s of the simulated disk, so what {} cost{} and leave{} is not known; a "
        "faster disk or a larger τ may help.",
        views == 1 ? "1 view was" : fmt::format("{} views were", views), suggestSettleS,
        views == 1 ? "it" : "they", views == 1 ? "s" : "", views == 1 ? "s" : "");
}

Json figuresJson(const SuggestFigures& figures) {
    Json json;
    for (const SuggestLimit limit : suggestLimits) {
        const double value = valueOfLimit(figures, limit);
        json[std::string(textOf(limit).key)] = std::isnan(value) ? Json(nullptr) : Json(value);
    }
    json["p99_error_px"] = figures.p99ErrorPx;
    json["mean_error_px"] = figures.meanErrorPx;
    json["worst_pop_px"] = figures.worstPopPx;
    json["pops"] = figures.pops;
    json["thrashes"] = figures.thrashes;
    json["late_share"] = figures.lateShare;
    json["frames"] = figures.frames;
    json["unsettled"] = figures.unsettled;
    return json;
}

Json candidateJson(const SuggestCandidate& candidate) {
    return {{"tau_px", candidate.tauPx},
            {"metric", metricName(candidate.metric)},
            {"morph_range", candidate.morphRange},
            {"paging_budget_mib", candidate.memoryMiB},
            {"chunk_size", candidate.chunkSize > 0 ? Json(candidate.chunkSize) : Json(nullptr)},
            {"regions", candidate.plan}};
}

}  // namespace

std::vector<SuggestRow> rowsOf(const SuggestOutcome& outcome) {
    std::vector<SuggestRow> rows;
    for (const SuggestLimit limit : suggestLimits) {
        const double before = valueOfLimit(outcome.beforeMeasured.figures, limit);
        const double after = valueOfLimit(outcome.measured.figures, limit);
        if (!outcome.budget[limit] && std::isnan(after)) continue;
        rows.push_back({limit, outcome.budget[limit], before, after, verdictOf(outcome, limit)});
    }
    return rows;
}

std::string candidateText(const SuggestCandidate& candidate, std::string_view tau) {
    std::string text = fmt::format("{} {:.3g} px, {}, morph range {:g}, {} MiB", tau, candidate.tauPx,
                                   metricName(candidate.metric), candidate.morphRange, candidate.memoryMiB);
    if (candidate.chunkSize > 0) text += fmt::format(", chunks of {}", candidate.chunkSize);
    if (!candidate.regions.empty())
        text += fmt::format(", {} x {:g}", candidate.plan, candidate.regions.front().tauFactor.value_or(1));
    return text;
}

std::string verdictText(const SuggestOutcome& outcome) {
    const bool isPredicted =
        outcome.budget[SuggestLimit::FrameMs] && (!outcome.cost || !outcome.cost->isMeasured);
    const char* const predicted = isPredicted ? ", with frame times that are predicted and not measured" : "";
    if (outcome.isMet && outcome.found.isUnchanged)
        return fmt::format("The settings already meet the budget of {}{}. Nothing needs to change.",
                           budgetText(outcome.budget), predicted);
    if (outcome.isMet) {
        return fmt::format("The suggested settings meet the budget of {}{}.{}", budgetText(outcome.budget),
                           predicted, regionsNote(outcome));
    }
    const auto binds = bindingLimit(outcome.budget, outcome.measured.figures.values);
    std::string text = fmt::format("The budget of {} is not met.", budgetText(outcome.budget));
    const bool isKept = keepsSettings(outcome);
    if (binds && !std::isnan(valueOfLimit(outcome.measured.figures, *binds))) {
        const double value = valueOfLimit(outcome.measured.figures, *binds);
        text += fmt::format(" The budget of {} binds: the {} have {} of {}.", textOf(*binds).noun,
                            isKept ? "settings of now" : "closest settings", limitText(*binds, value),
                            limitText(*binds, *outcome.budget[*binds]));
    }
    if (outcome.found.isUnchanged && !outcome.drawnFrames.empty())
        text += " By the fitted cost they meet it, so nothing was searched, but a drawn frame takes longer.";
    else if (isKept && !outcome.found.isUnchanged)
        text += " Nothing that was found is better, so no setting changes.";
    return text + unsettledText(outcome) + needsText(outcome);
}

std::string scopeText(const SuggestOutcome& outcome) {
    std::vector<std::string> parts;
    for (std::size_t i = 0; i < outcome.legs.size(); ++i)
        parts.push_back(fmt::format("{} ({} frames)", outcome.legs[i], outcome.frames[i]));
    return fmt::format(
        "Measured were {}, in pictures of {}x{} pixels with a field of view of {:.4g}\u00b0{}. Triangles and "
        "errors depend on both. A budget is met if 99.9 % of the frames of each flight and all viewpoints "
        "are "
        "within it; the worst places can be among the others. The figures are those of the written preset "
        "and "
        "regions, read back and measured again.",
        fmt::join(parts, ", "), outcome.size.widthPx, outcome.size.heightPx, outcome.before.camera.fovDeg,
        outcome.hasRecordings ? ", except recordings, which keep their own" : "");
}

std::string effortText(const SuggestOutcome& outcome) {
    return fmt::format("The search took {} measurements of samples and {} of all frames, {} in all.",
                       outcome.found.samples, outcome.found.wholes, durationText(outcome.elapsedS));
}

std::string frameTimeText(const SuggestOutcome& outcome) {
    if (!outcome.budget[SuggestLimit::FrameMs] || !outcome.cost) return "";
    const FrameCost& cost = *outcome.cost;
    if (!cost.isMeasured)
        return fmt::format("Frame times are predicted by the cost that was given, {}, and not measured.",
                           frameCostText(cost));
    std::string text = fmt::format(
        "Frame times are those of this machine, {}: {}, fitted to {} frames that were drawn here and raised "
        "above the slowest.",
        cost.machine, frameCostText(cost), cost.frames);
    if (outcome.drawnFrames.empty()) return text;
    const auto slowest = [](const std::vector<TimedFrame>& frames) {
        double worst = 0;
        for (const TimedFrame& frame : frames) worst = std::max(worst, frame.ms);
        return limitText(SuggestLimit::FrameMs, worst);
    };
    return text + fmt::format(
                      " Then {} frames were drawn with the settings before, the slowest in {}, and {} with "
                      "the suggested ones, the slowest in {}. A slower drawn frame counts instead of the "
                      "fitted time, before as well as suggested.",
                      outcome.drawnBefore.size(), slowest(outcome.drawnBefore), outcome.drawnFrames.size(),
                      slowest(outcome.drawnFrames));
}

std::string chunkSizeText(const SuggestOutcome& outcome) {
    const int chunkSize = outcome.found.best.candidate.chunkSize;
    const bool varies = std::ranges::any_of(
        outcome.found.trials, [](const SuggestTrial& trial) { return trial.candidate.chunkSize > 0; });
    if (chunkSize > 0)
        return fmt::format(
            "The suggestion has chunks of {0} vertices per side, as in {1}, which was baked with "
            "--chunk-size {0}.",
            chunkSize, outcome.file.string());
    if (varies) return "Other chunk sizes were measured too, and are not better.";
    return "The chunk size was not varied, because another one needs another bake.";
}

std::string methodText(const SuggestOutcome& outcome) {
    const std::string times = frameTimeText(outcome);
    return fmt::format("{} {}{}{} {}", scopeText(outcome), times, times.empty() ? "" : " ",
                       effortText(outcome), chunkSizeText(outcome));
}

std::vector<SuggestEffect> effectsOf(const SuggestOutcome& outcome) {
    const SuggestFigures& before = outcome.beforeMeasured.figures;
    const SuggestFigures& after = outcome.measured.figures;
    const auto px = [](double value) { return limitText(SuggestLimit::ErrorPx, value); };
    std::vector<SuggestEffect> effects = {
        {"Drawn error, 99th percentile of frames", px(before.p99ErrorPx), px(after.p99ErrorPx)},
        {"Drawn error, mean of frames", px(before.meanErrorPx), px(after.meanErrorPx)},
        {"Largest pop", px(before.worstPopPx), px(after.worstPopPx)},
        {"Pops", fmt::format("{}", before.pops), fmt::format("{}", after.pops)},
        {"Thrashes", fmt::format("{}", before.thrashes), fmt::format("{}", after.thrashes)},
        {"Drawn chunks that wait for data", fmt::format("{:.2f} %", 100 * before.lateShare),
         fmt::format("{:.2f} %", 100 * after.lateShare)}};
    if (before.unsettled + after.unsettled > 0)
        effects.push_back({"Views that were not loaded in time", fmt::format("{}", before.unsettled),
                           fmt::format("{}", after.unsettled)});
    return effects;
}

std::string placeCaption(const SuggestPlace& place) {
    const std::string value = limitText(place.limit, place.value);
    return fmt::format(
        "{} at {}, {} up",
        place.limit == SuggestLimit::Triangles ? value
                                               : fmt::format("{} {}", textOf(place.limit).name, value),
        placeText(place.pose.latitudeDeg, place.pose.longitudeDeg, 2), distanceText(place.pose.altitudeM));
}

std::string suggestMarkdown(const SuggestOutcome& outcome, const SuggestRequest& request,
                            const std::string& name, bool hasPicture) {
    std::string text = fmt::format("# Suggested settings for {}\n\n{}\n\n", request.file.filename().string(),
                                   verdictText(outcome));
    text += "| budget | limit | before | suggested | verdict |\n|---|---|---|---|---|\n";
    for (const SuggestRow& row : rowsOf(outcome)) {
        text += fmt::format("| {} | {} | {} | {} | {} |\n", textOf(row.limit).name,
                            row.budget ? limitText(row.limit, *row.budget) : "none",
                            limitText(row.limit, row.before), limitText(row.limit, row.after), row.verdict);
    }
    text += "\n## Settings\n\n";
    if (outcome.changes.empty() && outcome.regionsText.empty()) {
        text += "No setting changes.\n";
    } else {
        text += "| setting | before | suggested |\n|---|---|---|\n";
        for (const SettingDifference& change : outcome.changes)
            text += fmt::format("| `{}` | {} | {} |\n", change.setting, change.here, change.there);
        if (!outcome.regionsText.empty())
            text += fmt::format("\nThe regions are in `{}.regions.toml`.\n", name);
    }
    text += fmt::format("\n`{}` draws the planet with them.\n", drawLine(outcome, request, name));
    text += "\n## What it costs and leaves\n\n| | before | suggested |\n|---|---|---|\n";
    for (const SuggestEffect& effect : effectsOf(outcome))
        text += fmt::format("| {} | {} | {} |\n", effect.name, effect.before, effect.after);
    text +=
        "\nThe drawn error is an upper bound of the distance between the drawn surface, morphs included, and "
        "the "
        "finest data, on the screen. Memory is that of the chunks, resident or needed, whichever is more.\n";
    text += "\n## Worst places\n\n";
    if (hasPicture)
        text += fmt::format("![The page with pictures of the places]({}.png)\n\n", linkTarget(name));
    if (!outcome.noPictures.empty()) text += outcome.noPictures + "\n\n";
    for (const SuggestPlace& place : outcome.places)
        text += fmt::format("- {}, on {}: `{}`\n", placeCaption(place), place.leg, place.line);
    text += fmt::format("\n## How it was measured\n\n{}\n", methodText(outcome));
    if (outcome.settings.paging.badDisk.latencyMs == 0 && outcome.settings.paging.badDisk.bandwidthMBs == 0)
        text += "Data arrived without delay, because the settings simulate no disk.\n";
    else
        text += fmt::format("Data came from a simulated disk of {:g} ms and {:g} MB/s.\n",
                            outcome.settings.paging.badDisk.latencyMs,
                            outcome.settings.paging.badDisk.bandwidthMBs);
    return text;
}

Json suggestJson(const SuggestOutcome& outcome, const SuggestRequest& request) {
    Json json = {{"file", request.file.string()},
                 {"budget", budgetText(outcome.budget)},
                 {"met", outcome.isMet},
                 {"unchanged", outcome.found.isUnchanged},
                 {"verdict", verdictText(outcome)}};
    const auto binds = bindingLimit(outcome.budget, outcome.measured.figures.values);
    json["binds"] = binds ? Json(textOf(*binds).key) : Json(nullptr);
    json["limits"] = Json::array();
    for (const SuggestRow& row : rowsOf(outcome)) {
        json["limits"].push_back({{"limit", textOf(row.limit).key},
                                  {"budget", row.budget ? Json(*row.budget) : Json(nullptr)},
                                  {"verdict", row.verdict}});
    }
    json["before"] = figuresJson(outcome.beforeMeasured.figures);
    json["suggested"] = figuresJson(outcome.measured.figures);
    json["suggested"].update(candidateJson(outcome.found.best.candidate));
    json["changes"] = Json::array();
    for (const SettingDifference& change : outcome.changes)
        json["changes"].push_back(
            {{"setting", change.setting}, {"before", change.here}, {"suggested", change.there}});
    json["places"] = Json::array();
    for (const SuggestPlace& place : outcome.places) {
        json["places"].push_back({{"limit", textOf(place.limit).key},
                                  {"value", place.value},
                                  {"flight", place.leg},
                                  {"camera", poseJson(place.pose)},
                                  {"command", place.line}});
    }
    if (outcome.cost) {
        json["frame_cost"] = {{"fixed_ms", outcome.cost->fixedMs},
                              {"ms_per_million_triangles", outcome.cost->msPerMillion},
                              {"measured", outcome.cost->isMeasured},
                              {"machine", outcome.cost->machine}};
    }
    json["drawn_frames"] = {{"before", outcome.drawnBefore.size()},
                            {"suggested", outcome.drawnFrames.size()}};
    json["picture"] = {{"width_px", outcome.size.widthPx},
                       {"height_px", outcome.size.heightPx},
                       {"fov_deg", outcome.before.camera.fovDeg}};
    json["samples"] = outcome.found.samples;
    json["wholes"] = outcome.found.wholes;
    json["trials"] = Json::array();
    for (const SuggestTrial& trial : outcome.found.trials) {
        Json entry = candidateJson(trial.candidate);
        entry["scope"] = trial.scope == SuggestScope::Sample ? "sample" : "whole";
        entry.update(figuresJson(trial.figures));
        json["trials"].push_back(std::move(entry));
    }
    json["elapsed_s"] = outcome.elapsedS;
    return json;
}

}  // namespace worldy
