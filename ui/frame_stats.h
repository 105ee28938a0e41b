// What one frame did: counted and timed where it happened, for panels and reports.
#pragma once

#include "planet/gl/chunk_renderer.h"
#include "planet/lod_select.h"
#include "planet/planet.h"

namespace ui {

struct FrameStats {
    planet::SelectionCounters selection;
    planet::PagingCounters paging;
    planet::StageTimes stages;
    planet::gl::RenderCounters render;
    std::size_t gpuBytes = 0;  // all that the renderer holds
    double drawCpuMs = 0;      // making the draw calls
    double panelsMs = 0;
    double frameMs = 0;  // from this frame's start to the next one's
};

// Times with their flicker taken out; counts stay as they are.
FrameStats smoothed(const FrameStats& before, const FrameStats& now);

}  // namespace ui
