// Sweeps in the window: what the Sweep panel's commands do, and what is kept of what they brought. One
// thread, the window's.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "app/base/log.h"
#include "app/editor/session.h"
#include "app/measure/sweep_job.h"

namespace worldy {

// A sweep keeps to the chunk files that it began with: the planet may be closed, or baked anew, while it
// runs.
struct SweepDesk {
    std::unique_ptr<SweepJob> job{};  // at most one
    bool suggesting = false;          // what the job does
    std::vector<SweptFile> files{};   // of the table
    planet::HeightSourceSettings sourceSettings{};
    std::filesystem::path bakeSource{};  // of the files; empty where it is not known
    std::optional<SweepTable> table{};
    std::vector<SweepSuggestion> suggestions{};
    std::string problem{};
};

// What is asked of the planet that is shown, with the settings as they are but for what has no part in it:
// overlays, the bad disk and simulated reads. Chunk sizes other than the planet's are bakes in the cache,
// with the settings of its own. The Error says where there can be none since the source is not known.
planet::Result<SweepPlan> sweepPlanOf(const OpenPlanet& open, const SweepRequest& request,
                                      const ViewSettings& settings);

// open: null where no planet is. What cannot be begun is told in the log and by the panel.
void startSweep(SweepDesk& desk, const OpenPlanet* open, const SweepRequest& request,
                const ViewSettings& settings, const Log& log);
void cancelSweep(SweepDesk& desk);
// Once a frame: takes what has come.
void advanceSweep(SweepDesk& desk, const Log& log);

// Shows the chunks of a size that was swept, without a bake where they are still there.
void openSweptChunks(const SweepDesk& desk, int chunkSize, Session& session, const ViewSettings& settings,
                     const Log& log);

// A table that is whole: as CSV and JSON, and as a plot beside them under the same new name, in a folder that
// is there. Returns the plot's name. Where the plot cannot be drawn the Error says so, and the tables stay.
planet::Result<std::filesystem::path> saveSweep(const SweepDesk& desk, SweepCost cost,
                                                const std::filesystem::path& folder);

ui::SweepView sweepViewOf(const SweepDesk& desk);

}  // namespace worldy
