// What the program holds, by kind, at one moment: counted by the application, shown by the Frame panel.
#pragma once

#include <cstddef>
#include <optional>

#include "planet/gl/device/object_counts.h"
#include "planet/gl/draw/render_counters.h"

namespace worldy::ui {

struct Allocations {
    double atS = 0;  // since the program began
    // Of the process, bytes and numbers; 0 where the system does not tell.
    std::size_t residentBytes = 0;
    std::size_t heapBytes = 0;  // handed out by the allocator and not given back
    std::size_t openFiles = 0;  // sockets and pipes counted in
    std::size_t threads = 0;
    // Of all planets that are open, and of the pictures drawn into.
    planet::gl::GpuMemory gpu{};
    std::size_t targetBytes = 0;
    planet::gl::ObjectCounts objects{};  // of the window's context, the panels' own counted in
    // Of all planets that are open.
    std::size_t planets = 0;
    std::size_t chunks = 0;  // resident, as the tiles
    std::size_t chunkSlots = 0;
    std::size_t colourTiles = 0;
    std::size_t normalTiles = 0;
    std::size_t requests = 0;        // page-ins queued or being read
    std::size_t rememberedEnds = 0;  // of requests
    // What the program keeps for the user to look back at.
    std::size_t logLines = 0;
    std::size_t frameSamples = 0;
    std::size_t recordedBytes = 0;  // of a flight that is being recorded
    std::size_t jobs = 0;           // bakes and measurements under way in the background
};

struct AllocationsView {
    std::optional<Allocations> now{};  // at most a second old while the Frame panel is shown; none at first
    Allocations mark{};                // to compare with: when the first planet was there, or as marked since
};

}  // namespace worldy::ui
