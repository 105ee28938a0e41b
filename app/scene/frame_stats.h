// What one frame did: counted and timed where it happened, for panels and reports.
#pragma once

#include <cstdint>
#include <string>

#include "planet/gl/draw/render_counters.h"
#include "planet/planet.h"
#include "planet/select/lod_select.h"

namespace worldy {

// Of the clipmap of colours, while there is one.
struct ClipmapStats {
    int windows = 0;                // of levels that are not kept whole
    int wholeLevel = 0;             // this and all coarser ones are
    std::int64_t filledTexels = 0;  // in the last frame
    std::string problem;            // why there is none though it is wanted; empty: nothing is wrong
};

struct FrameStats {
    planet::SelectionCounters selection;
    planet::PagingCounters paging;
    planet::StageTimes stages;
    planet::gl::RenderCounters render;
    planet::gl::GpuMemory gpuMemory;  // of the renderer
    ClipmapStats clipmap;
    std::size_t targetBytes = 0;   // of the pictures drawn into
    std::size_t processBytes = 0;  // the whole program's resident memory
    double drawCpuMs = 0;          // making the planet's draw calls
    double overlaysMs = 0;         // lines and labels over it, on the CPU
    double panelsMs = 0;           // making the panels
    double panelsGpuMs = 0;        // drawing them, by a timer query
    double presentMs = 0;          // handing the picture to the monitor, waiting for it included
    double frameMs = 0;            // from this frame's start to the next one's
};

// Times with their flicker taken out; counts stay as they are.
FrameStats smoothed(const FrameStats& before, const FrameStats& now);

}  // namespace worldy
