// Counts allocations of the program by kind, for the Frame panel.
#pragma once

#include <cstddef>

#include "app/session/session.h"
#include "ui/model/allocations_view.h"

namespace worldy {

// The objects whose memory is counted, and counts that only the caller knows.
struct AllocationSources {
    const Session& session;
    const Scene* other = nullptr;  // B of a comparison; null if there is none
    double timeS = 0;              // seconds since the window opened
    std::size_t targetBytes = 0;
    std::size_t logLines = 0;
    std::size_t frameSamples = 0;
    std::size_t recordedBytes = 0;
    std::size_t jobs = 0;  // besides the session's
};

// Needs the window's context current. Reads process data from the system, which may take some milliseconds.
ui::Allocations countAllocations(const AllocationSources& sources);

// Call at the end of a frame. Counts again if the last count is 1 s old and the Frame panel is shown, or if
// mark is set. The first count of the first planet is the first mark.
void watchAllocations(const AllocationSources& sources, bool panelShown, bool mark,
                      ui::AllocationsView& view);

}  // namespace worldy
