// The command worldy bench: measures the cost and the benefit of LOD, streaming and the file format, each
// against a plain implementation in the same run. Needs no display, but OpenGL.
#pragma once

#include "app/bench/bench_options.h"
#include "planet/base/result.h"

namespace worldy {

// Runs the benchmarks and returns true. Or compares two reports, and returns false if the second is worse anywhere. The
// Error names the file, or what the machine lacks. Bakes into a temporary folder, which is removed afterwards.
planet::Result<bool> runBench(const BenchOptions& options);

}  // namespace worldy
