// The counts and times of one frame, for panels and reports.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "planet/gl/draw/render_counters.h"
#include "planet/planet.h"
#include "planet/select/governor.h"
#include "planet/select/lod_types.h"

namespace worldy {

struct ClipmapStats {
    int windows = 0;                // number of windows, over the levels finer than wholeLevel
    int wholeLevel = 0;             // this level and all coarser ones are resident as a whole
    std::int64_t filledTexels = 0;  // in the last frame
    std::string problem;            // why a requested clipmap is missing; empty: no problem
};

// How a frame used its budgets (planet/select/governor.h).
struct BudgetUse {
    bool isOn = false;        // a budget is set
    bool isMeasured = false;  // and the cost of one is known
    planet::GovernorBudget binds = planet::GovernorBudget::CpuTime;
    planet::GovernorLimit limit = planet::GovernorLimit::None;
    double use = 0;                                          // of the budget that binds
    std::array<double, planet::governorBudgetCount> uses{};  // of each; 0: off or not measured
};

struct FrameStats {
    double tauPx = 0;  // with which the chunks were selected
    BudgetUse budget;
    planet::SelectionCounters selection;
    planet::PagingCounters paging;
    planet::StageTimes stages;
    planet::gl::RenderCounters render;
    planet::gl::GpuMemory gpuMemory;  // memory of the renderer
    ClipmapStats clipmap;
    std::size_t targetBytes = 0;   // memory of the render targets
    std::size_t processBytes = 0;  // resident memory of the process
    double drawCpuMs = 0;          // issuing the draw calls of the planet
    double overlaysMs = 0;         // lines and labels over the planet, on the CPU
    double panelsMs = 0;           // building the panels
    double panelsGpuMs = 0;        // drawing the panels, by a timer query
    double presentMs = 0;          // presenting the frame, including the wait for the monitor
    double frameMs = 0;            // of the frame before, from its start to the start of this one
};

// Returns the frame `now` with smoothed times; counts are not smoothed.
FrameStats smoothed(const FrameStats& before, const FrameStats& now);

}  // namespace worldy
