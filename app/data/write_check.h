// Keeps outputs from destroying files: no output may be a file that the same work reads, and none replaces a
// file of another kind unless the user says so. Every command and the window ask here before they write.
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
    Picture,   // as writePicture makes it: RGB, in the format that the file's extension names
    PngImage,  // any PNG
    LayerSet,  // TOML
    Preset,    // TOML, settings files too
    ItemMap,
};

struct OutputFile {
    std::filesystem::path path;  // empty: not written
    OutputKind kind = OutputKind::Json;
};

struct CommandFiles {
    std::vector<std::filesystem::path>
        inputs;  // a folder stands for all files in it; empty paths are skipped
    std::vector<OutputFile> outputs;
};

// Adds the files that a source of heights or colours stands for (a preset's name, a terrain's text, one of
// six faces) and the colour image beside it.
void addSource(CommandFiles& files, const std::filesystem::path& source);
// Adds a chunk file and the colour image beside it.
void addChunkFile(CommandFiles& files, const std::filesystem::path& chunkFile);

// An Error where an output is the same file as an input or as another output. Files are compared by device
// and inode, so links are seen through.
planet::Result<void> checkNotInputs(const CommandFiles& files);
// An Error where an output exists, is not empty and is of another kind. Devices and folders pass: writing
// refuses them itself.
planet::Result<void> checkKinds(const std::vector<OutputFile>& outputs);

// Both, for a command; overwrite: files of any kind may be replaced.
planet::Result<void> checkOutputs(const CommandFiles& files, bool overwrite);

}  // namespace worldy
