// Describes the results of planet/chunk_explanation.h in words. Pure functions; the Greek letters need
// applyTheme().
#pragma once

#include <string>

#include "planet/chunk_explanation.h"

namespace worldy::ui {

// Returns one or two sentences: "Drawn: eps 1.2 px is within tau 2.0 px."
std::string whyText(const planet::ChunkExplanation& chunk);

// Returns one to three words: "drawn", "culled by frustum".
const char* stateText(planet::ChunkState state);

}  // namespace worldy::ui
