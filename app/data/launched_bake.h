// A bake by other processes, which a command line of the user's starts: "mpirun -n 4" or "srun -N 8" before this program.
#pragma once

#include <functional>
#include <stop_token>
#include <string>

#include "app/data/bake_task.h"
#include "planet/bake/bake_report.h"
#include "planet/bake/job/unit_feed.h"
#include "planet/base/result.h"

namespace worldy {

// Returns the command for a shell: the launcher as it is, then this program with quoted arguments for the task. It goes on
// with the finished units of a bake that did not end.
std::string launchedCommand(const std::string& launcher, const BakeTask& task);

// Runs it until it ends, or until a stop is requested; then it interrupts the command, and ends it after some seconds. Calls
// onProgress for each progress that it tells. The Error is what the command wrote last.
planet::Result<planet::BakeReport> runLaunchedBake(
    const std::string& launcher, const BakeTask& task, const std::stop_token& stop,
    const std::function<void(const planet::JobProgress&)>& onProgress);

}  // namespace worldy
