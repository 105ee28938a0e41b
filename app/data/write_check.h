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
    Picture,  // as writePicture makes it: 8-bit RGB without geographic tags, in the format that its name says
    PngImage,  // any PNG
    LayerSet,  // TOML
    Preset,    // TOML, settings files too
    ItemMap,
};

struct OutputFile {
    std::filesystem::path path;  // empty: not written
    OutputKind kind = OutputKind::Json;
    bool makesFolder = false;  // the command makes its folder where that is not there
};

struct CommandFiles {
    std::vector<std::filesystem::path>
        inputs;  // a folder stands for all files in it; empty paths are skipped
    std::vector<OutputFile> outputs;
};

// Adds the files that a source of heights or colours stands for (a preset's name, a terrain's text, one of
// six faces) and the colour image beside it; of a chunk file what addChunkFile adds.
void addSource(CommandFiles& files, const std::filesystem::path& source);
// Adds a chunk file and the colour image that it is drawn with.
void addChunkFile(CommandFiles& files, const std::filesystem::path& chunkFile);

// An Error where an output is the same file as an input or as another output. Files are compared by device
// and inode, so links are seen through.
planet::Result<void> checkNotInputs(const CommandFiles& files);
// An Error where an output exists, is not empty and is of another kind.
planet::Result<void> checkKinds(const std::vector<OutputFile>& outputs);

// An Error where an output cannot be written: it is a folder or a device, its folder is not there or takes no
// files, its links lead nowhere, or no picture format has its extension. What is found before the work starts
// is not lost after it.
planet::Result<void> checkPlaces(const std::vector<OutputFile>& outputs);

// All three, for a command; overwrite: files of any kind may be replaced.
planet::Result<void> checkOutputs(const CommandFiles& files, bool overwrite);

}  // namespace worldy
