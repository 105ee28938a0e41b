// From what the user names to the chunk file that holds it.
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
    std::filesystem::path source;       // a chunk file, an elevation image, cube faces or a terrain's text
    std::filesystem::path chunkFile;    // the source itself, or its bake in the cache folder
    std::filesystem::path colourImage;  // colour.jpg or colour.png beside the source, or our Earth's for its
                                        // bakes; empty if none
    bool needsBake = false;
    planet::BakeSettings settings{};      // what it is to be baked with
    std::filesystem::path bakedColour{};  // the image of its tiles of colour; empty: none. Of a chunk file
                                          // that is opened by itself: where it is known where it lies
};

// A world's name stands for its source, its radius and its face size. The Error says that nothing is there. A
// bake in the cache that cannot be opened is baked again.
// colour: the image that its tiles of colour are baked from, empty for none; where not given, the colour
// image beside the source, if any.
planet::Result<DataSet> findDataSet(const std::filesystem::path& named, const planet::BakeSettings& settings,
                                    const planet::HeightSourceSettings& sourceSettings = {},
                                    const std::optional<std::filesystem::path>& colour = std::nullopt);

// Returns the colour image that a chunk file is drawn with: that beside it, that beside the image that its
// detail was added to, or our Earth's for its bakes. Empty if there is none.
std::filesystem::path colourImageOf(const std::filesystem::path& chunkFile);

// What a chunk file was made from, where it says so in a way that it can be made again: a terrain's text.
// Empty otherwise.
std::filesystem::path sourceOf(const planet::ChunkFileInfo& info);

// Where the bake of a source is kept. The name carries a hash of the source's path, size and time of change,
// of all six faces where it has them, of a terrain's text, of a colour image in the same way, and of all
// settings that change the file, so that a changed source is baked anew.
std::filesystem::path cachedBakeOf(const std::filesystem::path& source, const planet::BakeSettings& settings,
                                   const planet::HeightSourceSettings& sourceSettings = {},
                                   const std::filesystem::path& colour = {});

}  // namespace worldy
