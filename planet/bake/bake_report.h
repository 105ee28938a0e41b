// The progress of a bake, and its report at the end.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "planet/sphere/planet_shape.h"

namespace planet {

struct BakeProgress {
    std::uint64_t samplesDone = 0;
    std::uint64_t samplesTotal = 0;  // samples of leaves, plus texels of colour tiles
    double elapsedS = 0;
    double samplesPerS = 0;
    double remainingS = 0;
};
// Called from one thread at a time, a few times per second. Returning false cancels the bake.
using BakeProgressCallback = std::function<bool(const BakeProgress&)>;

struct BakeReport {
    PlanetShape shape;
    std::string quantumNotice;  // the source needs a finer quantum than the steps allow; empty: it does not
    std::uint64_t samples = 0;  // of all leaves, each distinct
    std::uint64_t chunks = 0;
    int coarsestLeafLevel = 0;  // the deepest level if the tree is dense
    std::uint64_t fileBytes = 0;
    std::uint64_t missingSamples = 0;
    float largestDeltaCM = 0;  // of the six roots, metres
    float largestDeltaTightM = 0;
    std::uint64_t colourTiles = 0;
    std::uint64_t colourBytes = 0;  // in the file
    std::string colourNotice;       // ColourSource::notice
    // These count only in a bake with BakeSettings::reuse.
    std::uint64_t copiedChunks = 0;       // chunks whose blocks were copied
    std::uint64_t copiedColourTiles = 0;  // all or none
    std::uint64_t sampledCells = 0;       // cells of leaves that were sampled; without reuse, of all leaves
    std::string reuseNotice;      // why nothing was copied, or what was damaged; empty: nothing to say
    bool reuseIsDamaged = false;  // where the earlier bake is damaged, chunks were baked
    double seconds = 0;
};

}  // namespace planet
