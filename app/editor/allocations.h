// Counts what the program holds by kind, for the Frame panel.
#pragma once

#include "ui/model/allocations_view.h"

namespace worldy {

struct Editor;
struct Session;

// Wants the window's context current. Reads what the system tells of the process: some milliseconds at worst.
ui::Allocations countAllocations(const Session& session, const Editor& editor);

// At a frame's end: counts anew where the last count is a second old, and only while the Frame panel is
// shown. The first count, of the first planet that is shown, is the first mark.
void watchAllocations(const Session& session, Editor& editor);

}  // namespace worldy
