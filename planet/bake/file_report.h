// Reports, verifies and probes a chunk file. All functions read the file depth first, and keep one path of chunks in memory
// for each thread.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "planet/bake/rim_steps.h"
#include "planet/base/result.h"
#include "planet/format/chunk_file.h"
#include "planet/source/height_source_types.h"
#include "planet/sphere/bounds.h"

namespace planet {

struct LevelReport {
    int level = 0;
    std::uint64_t chunks = 0;
    std::uint64_t leaves = 0;  // of these chunks
    std::uint64_t bytes = 0;   // of the blocks that hold this level's chunks
    float minDeltaM = 0;       // of the δc of the level's chunks that are not leaves
    float medianDeltaM = 0;
    float p99DeltaM = 0;
    float maxDeltaM = 0;
    double meanDeltaM = 0;
    double meanTightM = 0;  // the tight metric over the same chunks
    float maxTightM = 0;
};

struct FileReport {
    std::uint64_t fileBytes = 0;
    std::uint64_t finestSamples = 0;  // distinct samples of all leaves
    double bitsPerFinestSample = 0;   // over all levels of heights
    std::vector<LevelReport> levels;
};

// Reports a file. Reads only the index, not the heights; a file with more than 65536 chunks on a level is read twice. Takes
// at most 1.5 MB for each such level. Runs on oneTBB's threads, and gives the same report for any number of them.
Result<FileReport> reportFile(const ChunkFile& file);

struct VerifyReport {
    std::uint64_t chunks = 0;       // read and checked
    std::uint64_t edges = 0;        // shared edges compared
    std::uint64_t leafSamples = 0;  // compared with the source; 0 without one
    std::uint64_t problemCount = 0;
    std::uint64_t sourceProblems = 0;   // compared chunks whose heights differ from the source
    std::vector<std::string> problems;  // the first 100, each naming its chunk
    std::optional<RimReport> rims;      // nothing if all leaves have one level
};

// Called every few hundred chunks, by any thread but one at a time. Returning false cancels.
using VerifyProgressCallback = std::function<bool(std::uint64_t chunksDone, std::uint64_t chunksTotal)>;

// Verifies every checksum; that δc and the tight metric match the heights and never increase downwards; that
// extremes contain all finest heights and bounds contain every vertex; that two chunks of a level have the
// same edge where they meet, which makes the edges of leaves of different levels agree too; and that the
// header counts the chunks. With its source, opened with the same settings, it also compares the heights of
// all leaves. Runs on oneTBB's threads, and gives the same report for any number of them. Damage is a problem
// in the report; the Error is for a source that is unreadable or belongs to another planet.
Result<VerifyReport> verifyFile(const ChunkFile& file, const HeightSource* source,
                                const VerifyProgressCallback& progress = {});

struct ProbeChunk {
    ChunkId id;
    float deltaCM = 0;
    float deltaTightM = 0;
    double minHeightM = 0;  // over its finest samples
    double maxHeightM = 0;
    double heightM = 0;  // of this chunk's surface at the place
    ChunkBounds bounds;
};

struct ProbeReport {
    FacePoint place;
    double heightM = 0;             // on the finest surface
    std::vector<ProbeChunk> chain;  // root first
};

Result<ProbeReport> probeFile(const ChunkFile& file, const Geographic& place);

}  // namespace planet
