// What was drawn, as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "app/scene.h"

namespace worldy {

nlohmann::ordered_json jsonOf(const planet::CameraPose& pose);

// Counts, bytes and times of one frame.
nlohmann::ordered_json jsonOf(const ui::FrameStats& stats);

// How many chunks of each level are drawn, index by level.
std::vector<std::uint32_t> levelHistogram(const planet::Selection& selection);

}  // namespace worldy
