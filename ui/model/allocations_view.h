// Allocations of the program by kind at one moment. The application counts them; the Frame panel shows them.
#pragma once

#include <cstddef>
#include <optional>

#include "planet/gl/device/object_counts.h"
#include "planet/gl/draw/render_counters.h"

namespace worldy::ui {

// Bytes and counts; 0 if the system does not report them.
struct ProcessAllocations {
    std::size_t residentBytes = 0;
    std::size_t heapBytes = 0;  // allocated and not yet freed
    std::size_t openFiles = 0;  // including sockets and pipes
    std::size_t threads = 0;
    std::size_t jobs = 0;  // background bakes and measurements
};

// Sums over all open planets.
struct PlanetAllocations {
    std::size_t count = 0;
    std::size_t chunks = 0;  // resident, as are the tiles below
    std::size_t chunkSlots = 0;
    std::size_t colourTiles = 0;
    std::size_t normalTiles = 0;
    std::size_t requests = 0;  // page-ins queued or being read
};

// Data that is kept so that the user can look back.
struct HistoryAllocations {
    std::size_t rememberedEnds = 0;  // requests in the paging histories
    std::size_t logLines = 0;
    std::size_t frameSamples = 0;
    std::size_t recordedBytes = 0;  // of a flight being recorded
};

struct Allocations {
    double atS = 0;  // seconds since the program began
    ProcessAllocations process{};
    planet::gl::GpuMemory gpu{};         // of all open planets
    std::size_t targetBytes = 0;         // of render targets
    planet::gl::ObjectCounts objects{};  // of the window's context, including the panels' own
    PlanetAllocations planets{};
    HistoryAllocations history{};
};

struct AllocationsView {
    std::optional<Allocations> now{};  // at most 1 s old while the Frame panel is shown; none at first
    Allocations mark{};                // set when the first planet opens, then by MarkAllocations
};

}  // namespace worldy::ui
