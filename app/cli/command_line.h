// The command line: what may be written on it, and where it leads.
#pragma once

#include <span>

#include "app/cli/shot_command.h"
#include "planet/base/result.h"

namespace worldy {

// The program's exit code: 0, 1 where a check has failed, 2 for bad input or a failing disk, standard
// output's too, 130 when cancelled.
int runCommandLine(int argumentCount, const char* const* arguments);

// What `worldy shot ...` would draw, program name first.
planet::Result<ShotOptions> shotOptionsFrom(std::span<const char* const> arguments);

}  // namespace worldy
