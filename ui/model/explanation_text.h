// Describes the results of planet/chunk_explanation.h in words. Pure functions; the Greek letters need
// applyTheme().
#pragma once

#include <string>

#include "planet/chunk_explanation.h"

namespace worldy::ui {

// Returns one or two sentences: "Drawn: eps 1.2 px is within tau 2.0 px."
std::string whyText(const planet::ChunkExplanation& chunk);

// Returns what a region does in a chunk: "part of it: tau x 0.5, level 6 or finer". demand: that of the chunk.
std::string regionText(const planet::RegionEffect& effect, const planet::ChunkDemand& demand);

// Returns one to three words: "drawn", "culled by frustum".
const char* stateText(planet::ChunkState state);

}  // namespace worldy::ui
