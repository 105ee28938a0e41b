// The command worldy bake: bakes a height source into a chunk file.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "planet/bake/bake.h"
#include "planet/source/height_source.h"

namespace worldy {

struct BakeOptions {
    std::vector<std::filesystem::path> sources;  // as given
    std::filesystem::path
        source;  // of them all: a path, a list of rasters, the text of a terrain, or the name of a world
    std::optional<std::string> detail;  // parameters of the added detail: "strength=0.8,octaves=4"
    std::filesystem::path output;
    planet::HeightSourceSettings sourceSettings;
    planet::BakeSettings settings;  // the radius is in radiusM
    std::optional<double> radiusM;  // unset: the world's, or the Earth's
    bool listPresets = false;       // prints the worlds and the kinds of terrain instead
    std::filesystem::path colour;   // image; empty: no colours
    bool json = false;
    bool resume = false;        // goes on with the finished units of a bake that did not end
    bool progressJson = false;  // writes the progress as lines of JSON
};

// Started by mpirun or srun, it bakes together with the other ranks; rank 0 writes all messages, and the Error of another
// rank has no message.
planet::Result<void> runBake(const BakeOptions& options);

}  // namespace worldy
