// What was drawn, as JSON, and JSON as text.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "app/scene.h"

namespace worldy {

// The version of the reports' keys and their meanings, the member "schema_version" of every JSON report and
// the first column of every CSV table. It grows by one whenever a key is removed or changes its meaning.
inline constexpr int schemaVersion = 1;

// Returns the report, an object, with "schema_version" before its members, in lines, the last one ended too.
// A file's name may be any bytes, and JSON is UTF-8: bytes that are not are replaced by U+FFFD.
std::string jsonText(const nlohmann::ordered_json& report);

// The destination of a command's report.
struct ReportTo {
    bool json = false;             // printed as JSON, in place of the tables
    std::filesystem::path file{};  // written there as JSON too; empty: nowhere
};
planet::Result<void> writeReport(const ReportTo& to, const nlohmann::ordered_json& report);

nlohmann::ordered_json poseJson(const planet::CameraPose& pose);

// Counts, bytes and times of one frame.
nlohmann::ordered_json statsJson(const ui::FrameStats& stats);

// How many chunks of each level are drawn, index by level.
std::vector<std::uint32_t> levelHistogram(const planet::Selection& selection);

}  // namespace worldy
