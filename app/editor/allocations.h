// Counts what the program holds by kind, for the Frame panel.
#pragma once

#include <cstddef>

#include "app/editor/session.h"
#include "ui/model/allocations_view.h"

namespace worldy {

// Holders of memory, and numbers that only the caller knows.
struct AllocationSources {
    const Session& session;
    const Scene* other = nullptr;  // compared with the one that is shown
    double timeS = 0;              // since the window opened
    std::size_t targetBytes = 0;
    std::size_t logLines = 0;
    std::size_t frameSamples = 0;
    std::size_t recordedBytes = 0;
    std::size_t jobs = 0;  // beside the session's
};

// Wants the window's context current. Reads what the system tells of the process: some milliseconds at worst.
ui::Allocations countAllocations(const AllocationSources& sources);

// At a frame's end: counts again if the last count is a second old and the Frame panel is shown, or if a mark
// is asked for. The first count, of the first planet that is shown, is the first mark.
void watchAllocations(const AllocationSources& sources, bool panelShown, bool mark,
                      ui::AllocationsView& view);

}  // namespace worldy
