#include "app/suggest/suggest_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

#include "app/base/output_file.h"
#include "app/base/picture_file.h"
#include "app/settings/region_file.h"
#include "app/settings/settings_text.h"
#include "app/suggest/suggest_budget.h"
#include "app/suggest/suggest_page.h"
#include "app/suggest/suggest_plans.h"
#include "app/suggest/suggest_report.h"
#include "app/suggest/suggest_run.h"
#include "planet/base/result.h"
#include "planet/base/try.h"
#include "planet/tree/region.h"

namespace worldy {

namespace {

using planet::Result;
namespace fs = std::filesystem;

Result<void> checkReadBack(const SuggestFiles& files, const SuggestRequest& request,
                           const SuggestOutcome& outcome) {
    TRY_ASSIGN(ViewSettings read, loadViewSettings(files.preset, request.view));
    read.regions = outcome.settings.regions;
    if (!(read == outcome.settings)) {
        return planet::ioError(fmt::format(
            "{}: does not read back as it was measured; expected the same settings", files.preset.string()));
    }
    if (outcome.regionsText.empty()) return {};
    TRY_ASSIGN(const auto regions, loadRegions(files.regions));
    if (regions == outcome.settings.regions.all()) return {};
    return planet::ioError(fmt::format("{}: does not read back as it was measured; expected the same regions",
                                       files.regions.string()));
}

// Returns whether a regions file has regions that a suggestion has named. Others may be the user's own.
bool holdsSuggestedRegions(const fs::path& file) {
    std::error_code status;
    if (!fs::is_regular_file(file, status)) return false;
    const auto regions = loadRegions(file);
    return regions && std::ranges::any_of(*regions, [](const planet::Region& region) {
               return isSuggestedName(region.name);
           });
}

// A file of an earlier suggestion must not be taken for one of this suggestion, which has no regions.
Result<void> removeEarlierRegions(const fs::path& file) {
    if (!holdsSuggestedRegions(file)) return {};
    std::error_code status;
    fs::remove(file, status);
    if (!status) return {};
    return planet::ioError(
        fmt::format("{}: holds the regions of an earlier suggestion and cannot be removed: {}", file.string(),
                    status.message()));
}

}  // namespace

SuggestFiles suggestFilesIn(const fs::path& folder, const std::string& name) {
    return {folder / (name + ".toml"), folder / (name + std::string(regionsFileEnding)),
            folder / (name + ".md"), folder / (name + ".png")};
}

SuggestPage suggestPageOf(const SuggestOutcome& outcome, const SuggestRequest& request) {
    SuggestPage page;
    page.title = fmt::format("Suggested settings for {}", request.file.filename().string());
    page.isMet = outcome.isMet;
    page.paragraphs = {verdictText(outcome)};
    std::vector<std::vector<std::string>> budgets = {{"budget", "limit", "before", "suggested", "verdict"}};
    for (const SuggestRow& row : rowsOf(outcome)) {
        budgets.push_back({std::string(textOf(row.limit).name),
                           row.budget ? limitText(row.limit, *row.budget) : "none",
                           limitText(row.limit, row.before), limitText(row.limit, row.after), row.verdict});
    }
    std::vector<std::vector<std::string>> settings = {{"setting", "before", "suggested"}};
    for (const SettingDifference& change : outcome.changes)
        settings.push_back({change.setting, change.here, change.there});
    std::vector<std::vector<std::string>> effects = {{"what it costs and leaves", "before", "suggested"}};
    for (const SuggestEffect& effect : effectsOf(outcome))
        effects.push_back({effect.name, effect.before, effect.after});
    page.tables = {budgets};
    if (settings.size() > 1) page.tables.push_back(settings);
    page.tables.push_back(effects);
    const auto error = [](const SuggestFigures& figures) {
        return std::max(figures.values[static_cast<std::size_t>(SuggestLimit::ErrorPx)], 0.01);
    };
    const auto cost = [&](const SuggestFigures& figures) {
        return std::max(mostCostUse(outcome.budget, figures.values), 0.01);
    };
    page.limitsCosts = outcome.budget.limitsCosts();
    page.errorLimitPx = outcome.budget[SuggestLimit::ErrorPx].value_or(0);
    // Figures that are not known have no place in the plot.
    const auto addPoint = [&](const SuggestFigures& figures, bool isWhole, bool isBest, bool isBefore) {
        const SuggestPage::Point point{error(figures), cost(figures), isWhole, isBest, isBefore};
        if (std::isfinite(point.errorPx) && std::isfinite(point.costShare)) page.points.push_back(point);
    };
    if (page.limitsCosts) {
        for (const SuggestTrial& trial : outcome.found.trials)
            addPoint(trial.figures, trial.scope == SuggestScope::Whole, false, false);
        addPoint(outcome.beforeMeasured.figures, true, false, true);
        addPoint(outcome.measured.figures, true, true, false);
    }
    for (const SuggestPlace& place : outcome.places)
        page.places.push_back({placeCaption(place), place.picture});
    page.notes = methodText(outcome);
    if (!outcome.noPictures.empty()) page.notes += " " + outcome.noPictures;
    return page;
}

Result<std::vector<fs::path>> writeSuggestion(const SuggestOutcome& outcome, const SuggestRequest& request,
                                              const fs::path& folder, const std::string& name) {
    const SuggestFiles files = suggestFilesIn(folder, name);
    std::error_code status;
    fs::create_directories(folder, status);  // writing reports a failure
    // The page comes first, because a missing font must not leave the other files behind.
    TRY_ASSIGN(const Picture page, drawSuggestPage(suggestPageOf(outcome, request)));
    std::vector<fs::path> written;
    TRY(writeTextFile(files.preset, outcome.presetText));
    written.push_back(files.preset);
    if (!outcome.regionsText.empty()) {
        TRY(writeTextFile(files.regions, outcome.regionsText));
        written.push_back(files.regions);
    } else {
        TRY(removeEarlierRegions(files.regions));
    }
    TRY(checkReadBack(files, request, outcome));
    TRY(writePicture(page, files.page));
    written.push_back(files.page);
    TRY(writeTextFile(files.report, suggestMarkdown(outcome, request, name, true)));
    written.push_back(files.report);
    return written;
}

}  // namespace worldy
