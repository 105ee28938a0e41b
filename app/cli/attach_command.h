// The command worldy attach: receives the trace of a running engine (planet/trace/lod_trace.h) and writes it into a file.
// Needs no GL.
#pragma once

#include <filesystem>
#include <optional>

#include "planet/base/result.h"

namespace worldy {

struct AttachOptions {
    int port = 0;                   // at 127.0.0.1 that the engine listens at, [1, 65535]
    std::filesystem::path out{};    // a new .lodtrace file, or a folder; empty: the current folder
    std::optional<double> seconds;  // ends after this time, > 0; unset: never
    bool isOnce = false;            // ends when the engine leaves
    bool json = false;              // prints JSON instead of text
};

// Receives until Ctrl+C, the time is over, or the engine leaves, as the options say, and prints what came. Each connection
// has a file of its own, and no file is replaced. Returns true if a trace came. The Error says which option is wrong, or
// which file cannot be written.
planet::Result<bool> runAttach(const AttachOptions& options);

}  // namespace worldy
