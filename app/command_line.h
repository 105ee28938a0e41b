// The command line: what may be written on it, and where it leads.
#pragma once

namespace worldy {

// The program's exit code: 0, 2 for bad input or a failing disk, 130 when cancelled.
int runCommandLine(int argumentCount, const char* const* arguments);

}  // namespace worldy
