// What a line of the log names that a click can lead to. Any thread.
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

#include "planet/sphere/chunk_id.h"

namespace worldy::ui {

// The first chunk that a text names, "z_pos/3/1/2". Pure.
std::optional<planet::ChunkId> chunkNamedIn(std::string_view text);
// The first tile of colour, which is none: "colour tile z_pos/3/1/2". Pure.
std::optional<planet::ChunkId> colourTileNamedIn(std::string_view text);

// The first absolute path in a text that exists, the longest there: a name may hold blanks. Asks the file
// system.
std::optional<std::filesystem::path> fileNamedIn(std::string_view text);

}  // namespace worldy::ui
