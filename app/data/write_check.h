// Protects files from being overwritten: no output may be a file that the same command reads, and none
// replaces a file of another kind unless the user allows it. All commands and the window check here before
// they write.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "planet/base/result.h"

namespace worldy {

enum class OutputKind : std::uint8_t {
    ChunkFile,
    Json,
    Csv,
    Picture,   // as written by writePicture: 8-bit RGB, no GeoTIFF tags, format as in its name
    PngImage,  // any PNG
    LayerSet,  // TOML
    Preset,    // TOML, settings files too
    Layout,    // TOML
    ItemMap,
    Trace,
    Atlas,
    Regions,        // TOML
    SuggestReport,  // Markdown of worldy suggest
};

struct OutputFile {
    std::filesystem::path path;  // empty: no output
    OutputKind kind = OutputKind::Json;
    bool makesFolder = false;  // the command creates the folder if it does not exist
};

struct CommandFiles {
    std::vector<std::filesystem::path>
        inputs;  // a folder stands for all files in it; empty paths are ignored
    std::vector<OutputFile> outputs;
};

// Adds the files of a source of heights or colours (a preset, a terrain, an image or six faces) and the
// colour image beside it. For a chunk file, does the same as addChunkFile.
void addSource(CommandFiles& files, const std::filesystem::path& source);
// Adds a chunk file and the colour image that it is drawn with.
void addChunkFile(CommandFiles& files, const std::filesystem::path& chunkFile);

// Returns an Error if an output is the same file as an input or as another output, also through links.
planet::Result<void> checkNotInputs(const CommandFiles& files);
// Returns an Error if an output exists, is not empty and is of another kind.
planet::Result<void> checkKinds(const std::vector<OutputFile>& outputs);

// Returns an Error if an output cannot be written: it is a folder or a device, its folder does not exist or
// is not writable, its links are dangling, or no picture format has its extension. Checking before the work
// starts avoids losing its result.
planet::Result<void> checkPlaces(const std::vector<OutputFile>& outputs);

// Makes all three checks for a command. overwrite: files of any kind may be replaced.
planet::Result<void> checkOutputs(const CommandFiles& files, bool overwrite);

}  // namespace worldy
