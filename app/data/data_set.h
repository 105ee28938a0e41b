// Resolves the name that a user gives to a source and its chunk file.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "planet/bake/bake.h"
#include "planet/base/result.h"
#include "planet/format/chunk_file.h"
#include "planet/source/height_source.h"

namespace worldy {

struct DataSet {
    std::filesystem::path source;     // a chunk file, an elevation image, cube faces or the text of a terrain
    std::filesystem::path chunkFile;  // the source itself, or its bake in the cache folder
    std::filesystem::path colourImage;  // the image to draw; empty if there is none
    bool needsBake = false;
    planet::BakeSettings settings{};  // settings for the bake
    planet::HeightSourceSettings sourceSettings{};
    std::filesystem::path
        bakedColour{};  // the image of the colour tiles; empty if there is none or, for a chunk
                        // file that was opened directly, if the image is not found
};

// Finds the data set of a file, a terrain or a preset. A preset also sets the radius and the face size. A
// cached bake that cannot be opened needs a new bake. colour is the image for the colour tiles, empty for
// none; if it is not given, the image beside the source is used, if there is one. Nothing to open is an
// Error.
planet::Result<DataSet> findDataSet(const std::filesystem::path& named, const planet::BakeSettings& settings,
                                    const planet::HeightSourceSettings& sourceSettings = {},
                                    const std::optional<std::filesystem::path>& colour = std::nullopt);

// Returns the colour image that a chunk file is drawn with: the one beside it, the one beside the image that
// its detail was added to, or that of the built-in Earth for its bakes. Empty if there is none.
std::filesystem::path colourImageOf(const std::filesystem::path& chunkFile);

// Returns the text of the terrain that a chunk file was baked from, so that it can be baked again; otherwise
// empty.
std::filesystem::path sourceOf(const planet::ChunkFileInfo& info);

// Returns the path of a bake in the cache. Its name contains a hash of the path, size and modification time
// of all source files and of the colour image, of the text of a terrain, and of all settings that change the
// file, so that a changed source is baked again.
std::filesystem::path cachedBakeOf(const std::filesystem::path& source, const planet::BakeSettings& settings,
                                   const planet::HeightSourceSettings& sourceSettings = {},
                                   const std::filesystem::path& colour = {});

// The face size of a first look, a coarse bake that is shown until the whole one is there.
inline constexpr int firstLookFaceSize = 513;
// Returns the first look at a data set that needs a bake, in the cache too.
DataSet firstLookOf(const DataSet& whole);

// Returns the newest bake in the cache of a source of this name with the same chunk size and radius that says what it was
// baked from, so that a bake of the changed source can copy from it; empty if there is none.
std::filesystem::path earlierBakeOf(const std::filesystem::path& source,
                                    const planet::BakeSettings& settings);

}  // namespace worldy
