// The ranks of a bake on several machines, as this process sees them.
#pragma once

#include <memory>
#include <string>

#include "planet/bake/job/ranks.h"
#include "planet/base/result.h"

namespace worldy {

// Returns whether this process was started as one of several ranks, by mpirun or srun.
bool isOneOfSeveralRanks();

// Joins the other ranks; a process that was started alone is the only one. The Error says that this build has no MPI. Call it
// once, from the thread that will use the ranks; their end leaves the job.
planet::Result<std::unique_ptr<planet::Ranks>> joinRanks();

// Returns the version and the build of this program, which all ranks must share: "Worldy 0.1.0, build 1f0c...".
planet::Result<std::string> programBuild();

}  // namespace worldy
