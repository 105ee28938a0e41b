#include "app/settings/undo.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string_view>
#include <utility>

#include "app/base/text.h"
#include "app/settings/settings_text.h"
#include "planet/tree/region.h"

namespace worldy {

namespace {

// Returns the first region that was added, deleted or changed: "Region "Valley" added".
std::string regionsChange(const std::vector<planet::Region>& before,
                          const std::vector<planet::Region>& after) {
    std::size_t first = 0;
    while (first < before.size() && first < after.size() && before[first] == after[first]) ++first;
    if (before.size() < after.size()) return fmt::format("Region \"{}\" added", after[first].name);
    if (before.size() > after.size()) return fmt::format("Region \"{}\" deleted", before[first].name);
    return first < after.size() ? fmt::format("Region \"{}\"", after[first].name) : "Regions";
}

std::vector<SettingDifference> differencesOf(const ViewSettings& before, const ViewSettings& after) {
    Settings here, there;
    here.view = before;
    there.view = after;
    std::vector<SettingDifference> found = differences(here, there);
    if (before.regions.list != after.regions.list || before.regions.file != after.regions.file)
        found.push_back({"regions", {}, {}, regionsChange(before.regions.all(), after.regions.all())});
    return found;
}

// Endings of setting names that denote units.
struct UnitEnding {
    std::string_view ending;
    std::string_view unit;
};
constexpr std::array<UnitEnding, 7> unitEndings = {{
    {"_px", " px"},
    {"_mb_s", " MB/s"},
    {"_mb", " MiB"},
    {"_ms", " ms"},
    {"_deg", "°"},
    {"_m", " m"},
    {"_s", " s"},
}};

std::string clockOf(const std::string& hour) {
    return clockText(std::strtod(hour.c_str(), nullptr));
}

std::string nameOf(const SettingDifference& difference) {
    std::string_view key = difference.setting;
    key.remove_prefix(key.find('.') + 1);
    std::string_view unit;
    for (const UnitEnding& ending : unitEndings) {
        if (!key.ends_with(ending.ending)) continue;
        key.remove_suffix(ending.ending.size());
        unit = ending.unit;
        break;
    }
    const std::string& words = difference.label;
    if (difference.setting == "regions") return words;
    if (difference.there == "true") return words + " on";
    if (difference.there == "false") return words + " off";
    // A ramp or a path would be too long for the menu.
    if (difference.here.size() > 24 || difference.there.size() > 24) return words;
    if (difference.setting == "surface.sun_hour")
        return fmt::format("{} {} -> {}", words, clockOf(difference.here), clockOf(difference.there));
    const auto [here, there] = shortNumberTexts(difference.here, difference.there);
    return fmt::format("{} {} -> {}{}", words, here, there, unit);
}

std::string nameOf(const std::vector<SettingDifference>& found) {
    return found.size() == 1 ? nameOf(found.front()) : fmt::format("{} settings", found.size());
}

}  // namespace

std::string changeName(const ViewSettings& before, const ViewSettings& after) {
    return nameOf(differencesOf(before, after));
}

void UndoHistory::record(const ViewSettings& before, const ViewSettings& after, bool held, double timeS) {
    if (before != after) {
        std::vector<std::string> settings;
        for (const SettingDifference& difference : differencesOf(before, after))
            settings.push_back(difference.setting);
        const bool inTime = !held && timeS - lastChangeS_ <= undoMergeS;
        const bool grows =
            open_ && done_.back().after == before && (held_ || (inTime && done_.back().settings == settings));
        if (grows) {
            done_.back().after = after;
        } else {
            close();
            push({before, after, {}, std::move(settings)});
            open_ = true;
            held_ = held;
        }
        lastChangeS_ = timeS;
    }
    // A control may change its value in the frame in which it is released.
    if (held_ ? !held : timeS - lastChangeS_ > undoMergeS) close();
}

void UndoHistory::add(const ViewSettings& before, const ViewSettings& after, std::string name) {
    close();
    if (before == after) return;
    push({before, after, std::move(name), {}});
    undone_.clear();
}

void UndoHistory::push(Step step) {
    done_.push_back(std::move(step));
    if (done_.size() > maxUndoSteps) done_.pop_front();
}

void UndoHistory::close() {
    if (!open_) return;
    if (done_.back().before == done_.back().after)
        done_.pop_back();
    else
        undone_.clear();
    open_ = held_ = false;
}

void UndoHistory::replaceRegions(const RegionSettings& regions) {
    close();
    const auto replace = [&](ViewSettings& settings) {
        settings.regions.list = regions.list;
        settings.regions.file = regions.file;
    };
    const auto changesNothing = [&](Step& step) {
        const bool hadRegions = !(step.before.regions == step.after.regions);
        replace(step.before);
        replace(step.after);
        if (hadRegions) step.name.clear();  // it may name the regions
        return step.before == step.after;
    };
    std::erase_if(done_, changesNothing);
    std::erase_if(undone_, changesNothing);
}

std::optional<ViewSettings> UndoHistory::undo() {
    close();
    if (done_.empty()) return std::nullopt;
    undone_.push_back(std::move(done_.back()));
    done_.pop_back();
    return undone_.back().before;
}

std::optional<ViewSettings> UndoHistory::redo() {
    close();
    if (undone_.empty()) return std::nullopt;
    done_.push_back(std::move(undone_.back()));
    undone_.pop_back();
    return done_.back().after;
}

std::string UndoHistory::undoName() const {
    const auto step = std::find_if(done_.rbegin(), done_.rend(),
                                   [](const Step& candidate) { return candidate.before != candidate.after; });
    if (step == done_.rend()) return {};
    return step->name.empty() ? changeName(step->before, step->after) : step->name;
}

std::string UndoHistory::redoName() const {
    const bool clears = open_ && done_.back().before != done_.back().after;
    if (undone_.empty() || clears) return {};
    const Step& step = undone_.back();
    return step.name.empty() ? changeName(step.before, step.after) : step.name;
}

}  // namespace worldy
