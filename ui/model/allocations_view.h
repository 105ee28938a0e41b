// Allocations of the program by kind at one moment. The application counts them; the Frame panel shows them.
#pragma once

#include <cstddef>
#include <optional>

#include "planet/gl/device/object_counts.h"
#include "planet/gl/draw/render_counters.h"

namespace worldy::ui {

// Bytes and numbers; 0 where the system does not tell.
struct ProcessAllocations {
    std::size_t residentBytes = 0;
    std::size_t heapBytes = 0;  // allocated and not yet freed
    std::size_t openFiles = 0;  // including sockets and pipes
    std::size_t threads = 0;
    std::size_t jobs = 0;  // bakes and measurements under way in the background
};

// Of all planets that are open.
struct PlanetAllocations {
    std::size_t count = 0;
    std::size_t chunks = 0;  // resident, as the tiles
    std::size_t chunkSlots = 0;
    std::size_t colourTiles = 0;
    std::size_t normalTiles = 0;
    std::size_t requests = 0;  // page-ins queued or being read
};

// What the program keeps for the user to look back at.
struct HistoryAllocations {
    std::size_t rememberedEnds = 0;  // of requests
    std::size_t logLines = 0;
    std::size_t frameSamples = 0;
    std::size_t recordedBytes = 0;  // of a flight that is being recorded
};

struct Allocations {
    double atS = 0;  // since the program began
    ProcessAllocations process{};
    planet::gl::GpuMemory gpu{};         // of all planets that are open
    std::size_t targetBytes = 0;         // of the pictures drawn into
    planet::gl::ObjectCounts objects{};  // of the window's context, the panels' own counted in
    PlanetAllocations planets{};
    HistoryAllocations history{};
};

struct AllocationsView {
    std::optional<Allocations> now{};  // at most 1 s old while the Frame panel is shown; none at first
    Allocations mark{};                // set when the first planet opens, then by MarkAllocations
};

}  // namespace worldy::ui
