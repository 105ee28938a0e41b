// worldy bench: what LOD, streaming and the file's format cost and gain, each beside a plain way to do the
// same, paired within one run. Needs no display, but OpenGL.
#pragma once

#include "app/cli/bench_options.h"
#include "planet/base/result.h"

namespace worldy {

// The Error names the source, or what the machine lacks. Bakes into a temporary folder, which is gone
// afterwards.
planet::Result<void> runBench(const BenchOptions& options);

}  // namespace worldy
