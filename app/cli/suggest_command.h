// The command worldy suggest: finds settings that meet a budget, measures them, and writes them with a report of a page.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/settings/camera_text.h"
#include "app/settings/view_settings.h"
#include "app/suggest/frame_cost.h"
#include "app/suggest/suggest_budget.h"
#include "app/suggest/suggest_run.h"
#include "planet/base/result.h"
#include "planet/measure/atlas.h"
#include "planet/source/height_source.h"

namespace worldy {

struct SuggestOptions {
    std::filesystem::path file;    // a chunk file, or a trace
    std::filesystem::path output;  // folder
    std::string name = "suggested";
    bool json = false;
    SuggestBudget budget;
    std::vector<std::filesystem::path> flights;
    std::vector<std::filesystem::path> recordings;
    std::vector<int> chunkSizes;   // that may be baked and suggested; empty: the file's alone
    std::filesystem::path source;  // of these bakes; empty: the one that the file names
    planet::HeightSourceSettings sourceSettings{};
    std::vector<double>
        altitudesM;  // of viewpoints; empty: none, or the usual ones if nothing else is measured
    int viewpoints = 600;
    double stepS = 1.0 / 30;
    SuggestVary vary;
    std::optional<FrameCost> cost;
    bool drawsPictures = true;
    PictureSize size;
    ViewSettings view;
};

// Returns false if the budget is not met; the closest settings are written nevertheless.
planet::Result<bool> runSuggestCommand(const SuggestOptions& options);

}  // namespace worldy
