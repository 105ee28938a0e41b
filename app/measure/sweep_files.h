// Finds and bakes the chunk files of other chunk sizes.
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "planet/bake/bake.h"
#include "planet/base/result.h"
#include "planet/source/height_source.h"

namespace worldy {

// The colour image for the bakes of a sweep. It is empty, because sweeps neither load nor draw colours.
inline const std::filesystem::path sweptColour{};

// The chunk file of one chunk size.
struct SweptFile {
    int chunkSize = 33;
    std::filesystem::path chunkFile;
    bool needsBake = false;  // the file does not exist yet
    planet::BakeSettings bake{};
};

struct SweptFiles {
    std::filesystem::path source;  // of the bakes; unused if none is needed
    std::vector<SweptFile> files;  // in the order of the chunk sizes
};
// Returns the files for chunk sizes of a chunk file or a source. A chunk file needs no bake for its own size; for others its
// recorded source, or the one that is given, is baked with its radius and face size into the cache. The Error says which
// source cannot be found.
planet::Result<SweptFiles> sweptFilesOf(const std::filesystem::path& file, const std::vector<int>& chunkSizes,
                                        const planet::HeightSourceSettings& sourceSettings,
                                        const std::filesystem::path& given = {});

// Bakes a file unless it is there. goOn: false cancels.
planet::Result<void> bakeSwept(const SweptFiles& swept, const SweptFile& file,
                               const planet::HeightSourceSettings& sourceSettings,
                               const std::function<bool(const planet::BakeProgress&)>& goOn);

}  // namespace worldy
