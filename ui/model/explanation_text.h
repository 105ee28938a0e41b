// What planet/chunk_explanation.h finds out, in words. Pure functions; the Greek letters need applyTheme.
#pragma once

#include <string>

#include "planet/chunk_explanation.h"

namespace worldy::ui {

// One or two plain sentences: "Drawn: eps 1.2 px is within tau 2.0 px."
std::string whyText(const planet::ChunkExplanation& chunk);

// In a word or three: "drawn", "culled by frustum".
const char* stateText(planet::ChunkState state);

}  // namespace worldy::ui
