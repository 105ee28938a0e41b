// Traces a planet of Worldy through the header that other engines use (planet/trace/lod_trace.h), so that the same tools
// read both. Call it from the planet's thread.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <unordered_map>
#include <unordered_set>

#include "planet/base/result.h"
#include "planet/paging/paging_types.h"
#include "planet/planet.h"
#include "planet/sphere/chunk_id.h"

struct lod_trace;

namespace worldy {

// The engine's clock of a frame, and its times.
struct TracedTimes {
    double timeS = 0;
    double cpuMs = -1;  // negative: unknown
    double gpuMs = -1;
};

class PlanetTrace {
public:
    // Creates the file; an existing trace is replaced. The planet keeps its moves until finish(). name: of the flight or the
    // scene. The Error names the file.
    static planet::Result<PlanetTrace> create(const std::filesystem::path& file, planet::Planet& planet,
                                              const std::string& name);

    // Tells the last step of the planet as a frame: its nodes, settings, views, drawn and culled chunks, and paging. Paging is
    // stamped with the time of this call, so that latencies are those of whole frames.
    void addFrame(planet::Planet& planet, const TracedTimes& times);

    // Writes what is left. The Error names the file that could not be written, or says that events were lost.
    planet::Result<void> finish(planet::Planet& planet);

private:
    // The values that were told of a chunk. It is told again if they change.
    struct Told {
        float errorM = 0;
        float maxHeightM = 0;
    };

    struct Close {
        void operator()(lod_trace* trace) const;
    };

    PlanetTrace(std::filesystem::path file, lod_trace* trace) : file_(std::move(file)), trace_(trace) {}
    void describe(const planet::Planet& planet, const std::string& name);
    void tellSettings(const planet::LodSettings& lod, std::size_t view);
    void tellNodes(const planet::Planet& planet, std::size_t view);
    void tellView(const planet::Planet& planet, std::size_t view);
    void tellPaging(planet::Planet& planet);
    void tellStarted(const planet::BlockId& block);

    std::filesystem::path file_;
    std::unique_ptr<lod_trace, Close> trace_;
    std::unordered_map<planet::ChunkId, Told> told_;
    std::unordered_map<std::string, double> settings_;
    std::uint64_t eventsBefore_ = 0;  // of the paging, at the last frame
    // Blocks that were told as requested and have not ended: those that wait for a loader, and the others.
    std::unordered_set<planet::BlockId> waiting_, started_;
};

}  // namespace worldy
