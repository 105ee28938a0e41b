// JSON that describes camera poses and drawn frames, for reports. Pure functions, any thread.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "app/scene/frame_stats.h"
#include "planet/select/lod_select.h"
#include "planet/sphere/view.h"

namespace worldy {

// Returns latitude, longitude, altitude, heading and pitch, in degrees and metres, rounded (roundedPose).
nlohmann::ordered_json poseJson(const planet::CameraPose& exact);

// Returns the counts, bytes and times of one frame.
nlohmann::ordered_json statsJson(const FrameStats& stats);

// Returns the number of drawn chunks of each level, indexed by level.
std::vector<std::uint32_t> drawnByLevel(const planet::Selection& selection);

}  // namespace worldy
