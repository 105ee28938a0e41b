// The layers of a world file while they are edited in the window. Main thread, except where it says otherwise.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "planet/base/result.h"
#include "planet/source/height_source.h"
#include "planet/source/world_file.h"

namespace worldy {

// A world file with the layers that are off, which are saved but not baked.
using WorldEdit = planet::WorldFile;

// Returns the layers of a source: those of a world file, or else one layer of the source itself; detail terrain is a
// layer over its source. The Error says what is wrong with the world file, or that source settings, which a world file
// does not have, apply to the source.
planet::Result<WorldEdit> editOf(const std::filesystem::path& source,
                                 const planet::HeightSourceSettings& settings);

// Returns whether two edits give the same file.
bool sameWorld(const WorldEdit& a, const WorldEdit& b);

// The Error says what is wrong with the world: no layer is on, or a file of it would be refused.
planet::Result<void> checkEdit(const WorldEdit& edit);

// Adds a layer of rasters on top. Its datum is that of the planet, if the world has one.
void addLayer(WorldEdit& edit, std::span<const std::filesystem::path> files);

// Writes the layers that are on for a bake into a folder, with a name from its content, and returns its path. Nothing is written if
// the file exists already, so that the bake of an unchanged world is found again.
planet::Result<std::filesystem::path> writeForBake(const WorldEdit& edit, const std::filesystem::path& folder,
                                                   const std::string& stem);

// Writes a world file as a user would: atomically, with paths relative to its folder. An existing file is replaced.
planet::Result<void> saveWorld(const WorldEdit& edit, const std::filesystem::path& file);

}  // namespace worldy
