// What the Sweep panel shows: many tolerances over one flight.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "planet/bake/bake.h"
#include "ui/model/sweep_points.h"

namespace ui {

// The points of the last sweep, or of the one that runs.
struct SweepTable {
    SweepRequest request;
    std::string flight;              // its name
    std::filesystem::path source;    // what was opened
    std::vector<SweepPoint> points;  // as they came; onFront is not set
    bool whole = false;              // all that were asked for
};

struct SweepSuggestion {
    int chunkSize = 33;
    planet::ErrorMetric metric = planet::ErrorMetric::Additive;
    TauGoal goal;
    TauSuggestion found;
};

struct SweepProgress {
    std::size_t flown = 0;    // flights that are done
    std::size_t flights = 0;  // in all; of a suggestion the most that there can be
    int frame = 0;            // moments of the flight that is flown
    int frames = 1;
    int chunkSize = 33;  // flown, or baked
    planet::ErrorMetric metric = planet::ErrorMetric::Additive;
    double tauPx = 0;                          // 0: none is flown yet
    std::optional<planet::BakeProgress> bake;  // while chunks of a size are baked
    std::optional<double> leftS;               // seconds, an estimate; none before the first moment is done
};

struct SweepView {
    const SweepTable* table = nullptr;             // null before the first sweep
    std::span<const SweepSuggestion> suggestions;  // to what was asked last, one a metric
    bool running = false;
    bool suggesting = false;  // what runs looks for a tau
    bool cancelling = false;  // but not yet at its end
    SweepProgress progress;
    std::string problem;  // why what ran last came to nothing, or ended early
};

}  // namespace ui
