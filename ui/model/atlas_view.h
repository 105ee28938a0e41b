// The state of the Atlas panel.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/measure/atlas_table.h"
#include "app/scene/atlas_drape.h"
#include "app/settings/setting_difference.h"
#include "planet/measure/atlas.h"
#include "planet/measure/atlas_run.h"
#include "planet/measure/atlas_sampling.h"

namespace worldy::ui {

// Compares the shown atlas with an earlier survey of the same viewpoints.
struct AtlasComparison {
    std::string earlier;  // the name of the earlier survey's file
    AtlasDiff diff;
    std::vector<planet::AtlasViewpoint> changes;  // of the shown viewpoints, in their order
    std::vector<planet::AtlasCell> cells;         // that are not split, with their changes
    std::vector<SettingDifference> settings;      // before, now
};

struct AtlasView {
    const planet::Atlas* atlas = nullptr;        // null before one is opened or surveyed
    std::string name{};                          // of its file; empty: it is not saved
    std::span<const planet::AtlasCell> cells{};  // that are not split
    std::span<const AtlasSpread> spreads{};      // of all its measures
    const AtlasDrape* drape = nullptr;           // of the chosen measure and altitude; null without an atlas
    int altitude = 0;                            // index of the chosen one
    std::string otherBake{};  // why it does not fit the shown planet; empty: it does, as far as is known
    bool running = false;
    std::string surveyed{};  // the planet of the running survey
    bool cancelling = false;
    std::optional<planet::AtlasProgress> progress{};  // none while the tree is read
    std::string problem{};                            // why the last survey or file failed
    const AtlasComparison* comparison = nullptr;      // null without one; then the drape is of no change
    std::string comparisonProblem{};                  // why an earlier survey could not be compared
};

}  // namespace worldy::ui
