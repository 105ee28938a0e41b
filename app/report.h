// What was drawn, as JSON, and JSON as text.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "app/scene.h"

namespace worldy {

// In lines, the last one ended too. A file's name may be any bytes, and JSON is UTF-8: what is not is
// replaced by U+FFFD.
std::string jsonText(const nlohmann::ordered_json& report);

nlohmann::ordered_json poseJson(const planet::CameraPose& pose);

// Counts, bytes and times of one frame.
nlohmann::ordered_json statsJson(const ui::FrameStats& stats);

// How many chunks of each level are drawn, index by level.
std::vector<std::uint32_t> levelHistogram(const planet::Selection& selection);

}  // namespace worldy
