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

// Returns, for each region of the planet that is on and touches a drawn chunk, its name, how many drawn chunks it touches, and
// in how many of them it decides the demand. Not for every frame: it takes about a microsecond for each drawn chunk.
nlohmann::ordered_json regionsJson(const planet::ChunkTree& tree, const planet::Selection& selection);

// Returns the number of drawn chunks of each level, indexed by level.
std::vector<std::uint32_t> drawnByLevel(const planet::Selection& selection);

}  // namespace worldy
