// Explains in sentences why an engine drew a node, split it or left it out, by the numbers of its trace.
#pragma once

#include <string>
#include <vector>

#include "app/trace/traced_frame.h"

namespace worldy {

// Returns the sentences about a node of a view of the frame, the most important one first. Pure, any thread.
std::vector<std::string> tracedReasons(const TracedFrame& frame, const TracedView& view,
                                       const TracedNode& node);

// Returns a length in the engine's units as metres or kilometres: "12.5 m", "369 km".
std::string tracedLengthText(double units, const std::optional<planet::TraceDescription>& description);
// Returns "drawn", "split", "culled by the frustum" and so on.
std::string tracedPlaceText(const TracedNode& node);
// Returns "resident", "requested", "being loaded", "absent" or "failed".
const char* tracedDataText(planet::TraceData data);

}  // namespace worldy
