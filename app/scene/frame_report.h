// JSON that describes camera poses and drawn frames, for reports. Pure functions, any thread.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "planet/select/lod_select.h"
#include "planet/sphere/view.h"
#include "ui/model/frame_stats.h"

namespace worldy {

// Returns latitude, longitude, altitude, heading and pitch, in degrees and metres, rounded (roundedPose).
nlohmann::ordered_json poseJson(const planet::CameraPose& exact);

// Returns the counts, bytes and times of one frame.
nlohmann::ordered_json statsJson(const ui::FrameStats& stats);

// Returns the number of drawn chunks of each level, indexed by level.
std::vector<std::uint32_t> drawnByLevel(const planet::Selection& selection);

}  // namespace worldy
