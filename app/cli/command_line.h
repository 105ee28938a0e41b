// Parses the command line and runs its command.
#pragma once

#include <span>

#include "app/cli/shot_command.h"
#include "planet/base/result.h"

namespace worldy {

// Returns the program's exit code: 0; 1 if a check failed; 2 for bad input or if reading or writing failed,
// including standard output; 130 if cancelled.
int runCommandLine(int argumentCount, const char* const* arguments);

// Returns the options of a `worldy shot ...` line; the first argument is the program's name.
planet::Result<ShotOptions> shotOptionsFrom(std::span<const char* const> arguments);

}  // namespace worldy
