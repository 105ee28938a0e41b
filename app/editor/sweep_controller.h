// Sweeps in the window: the Sweep panel's commands, and their results. Main thread.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "app/base/log.h"
#include "app/measure/kept_results.h"
#include "app/measure/sweep_files.h"
#include "app/measure/sweep_job.h"
#include "app/session/notices.h"
#include "app/session/session.h"
#include "ui/model/commands.h"

namespace worldy {

// A sweep keeps using the chunk files that it started with: the planet may be closed or rebaked while it
// runs.
struct SweepController {
    std::unique_ptr<SweepJob> job{};  // at most one
    bool suggesting = false;          // the job searches for a tau
    SweptFiles swept{};               // the chunk files of the table
    planet::HeightSourceSettings sourceSettings{};
    std::optional<SweepTable> table{};
    std::vector<SweepSuggestion> suggestions{};
    std::vector<MeasuredFile> measured{};      // the files of the table, as they were when it ended
    std::vector<MeasuredFile> suggestedFor{};  // the files of the suggestions, as they were when it began
    std::string problem{};
    bool cancelled = false;  // the problem is that the user cancelled
};

// Returns the plan of a sweep over the shown planet, with the current settings except overlays, fault
// injection and simulated reads. Other chunk sizes are bakes in the cache with the planet's other bake
// settings. The Error says that these are impossible because the source is not known.
planet::Result<SweepPlan> sweepPlanOf(const OpenPlanet& open, const SweepRequest& request,
                                      const ViewSettings& settings);

// Returns the chunk files of other chunk sizes, which are bakes in the cache with the planet's other settings. The Error is
// that of sweepPlanOf.
planet::Result<SweptFiles> sweptFilesOf(const OpenPlanet& open, const std::vector<int>& chunkSizes);
// Shows one of these files. A file that is gone is baked again.
void openSwept(const SweptFiles& files, const planet::HeightSourceSettings& sourceSettings, int chunkSize,
               Session& session, const ViewSettings& settings, const Log& log);

// open: null if no planet is open. The log and the panel report why a sweep cannot start.
void startSweep(SweepController& controller, const OpenPlanet* open, const SweepRequest& request,
                const ViewSettings& settings, const Log& log);
void cancelSweep(SweepController& controller);
// Call every frame; takes new results.
void advanceSweep(SweepController& controller, const Log& log);

// Saves a complete table as CSV and JSON, and the plot, under one new name in an existing folder. Returns the
// plot's file. If the plot cannot be drawn, the Error says so and the tables remain.
planet::Result<std::filesystem::path> saveSweep(const SweepController& controller, SweepCost cost,
                                                const std::filesystem::path& folder);

// Adds the results to those that the next start shows again. Call while none is being measured.
void keepResults(const SweepController& controller, KeptResults& kept);
// Shows the results of the last session again. What belongs to a file that has changed since is left out; the controller's
// problem and the log say so.
void restoreResults(SweepController& controller, const KeptResults& kept, const Log& log);

void execute(SweepController& controller, const ui::SweepCommand& command, Session& session,
             const ViewSettings& settings, Notices& notices);

ui::SweepView sweepViewOf(const SweepController& controller);

}  // namespace worldy
