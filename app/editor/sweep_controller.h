// Sweeps in the window: the Sweep panel's commands, and their results. Main thread.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "app/base/log.h"
#include "app/editor/notices.h"
#include "app/editor/session.h"
#include "app/measure/sweep_job.h"
#include "ui/model/commands.h"

namespace worldy {

// A sweep keeps to the chunk files that it began with: the planet may be closed or baked again while it runs.
struct SweepController {
    std::unique_ptr<SweepJob> job{};  // at most one
    bool suggesting = false;          // what the job does
    std::vector<SweptFile> files{};   // of the table
    planet::HeightSourceSettings sourceSettings{};
    std::filesystem::path bakeSource{};  // of the files; empty where it is not known
    std::optional<SweepTable> table{};
    std::vector<SweepSuggestion> suggestions{};
    std::string problem{};
};

// Returns the plan of a sweep over the shown planet, with the current settings except overlays, fault
// injection and simulated reads. Chunk sizes other than the planet's are bakes in the cache with the planet's
// other bake settings. The Error says that there can be none because the source is not known.
planet::Result<SweepPlan> sweepPlanOf(const OpenPlanet& open, const SweepRequest& request,
                                      const ViewSettings& settings);

// open: null while no planet is open. The log and the panel report why a sweep cannot start.
void startSweep(SweepController& controller, const OpenPlanet* open, const SweepRequest& request,
                const ViewSettings& settings, const Log& log);
void cancelSweep(SweepController& controller);
// Once a frame: takes the results that have come.
void advanceSweep(SweepController& controller, const Log& log);

// Shows the chunks of a size that was swept, without a bake if their file still exists.
void openSweptChunks(const SweepController& controller, int chunkSize, Session& session,
                     const ViewSettings& settings, const Log& log);

// Saves a complete table as CSV and JSON, and as a plot beside them under the same new name, in a folder that
// exists. Returns the plot's file. If the plot cannot be drawn, the Error says so and the tables stay.
planet::Result<std::filesystem::path> saveSweep(const SweepController& controller, SweepCost cost,
                                                const std::filesystem::path& folder);

void execute(SweepController& controller, const ui::SweepCommand& command, Session& session,
             const ViewSettings& settings, Notices& notices);

ui::SweepView sweepViewOf(const SweepController& controller);

}  // namespace worldy
