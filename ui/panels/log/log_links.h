// Finds chunks, tiles and files in the log's text that a click can lead to. Any thread.
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

#include "planet/sphere/chunk_id.h"

namespace worldy::ui {

// Returns the first chunk that a text names, such as "z_pos/3/1/2". Pure.
std::optional<planet::ChunkId> chunkNamedIn(std::string_view text);
// Returns the first colour tile that a text names; chunkNamedIn() skips these: "colour tile z_pos/3/1/2".
// Pure.
std::optional<planet::ChunkId> colourTileNamedIn(std::string_view text);

// Returns the first absolute path in a text that exists. At one position the longest path wins, since names
// may contain spaces. Reads the file system.
std::optional<std::filesystem::path> fileNamedIn(std::string_view text);

}  // namespace worldy::ui
