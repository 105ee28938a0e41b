// JSON reports: their version, their text, and where a command writes them. Any thread.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "planet/base/result.h"

namespace worldy {

// The version of the reports' keys and their meanings, the member "schema_version" of every JSON report and
// the first column of every CSV table. It grows by one whenever a key is removed or changes its meaning.
inline constexpr int schemaVersion = 2;

// Returns the report, an object, as lines of text with "schema_version" before its members; the last line
// ends with a newline. File names may hold any bytes but JSON is UTF-8: invalid bytes are replaced by U+FFFD.
std::string jsonText(const nlohmann::ordered_json& report);

// Returns whether the name of an output asks for a CSV table instead of JSON.
bool isCsvTable(const std::filesystem::path& file);

// The destination of a command's report.
struct ReportTo {
    bool json = false;             // prints JSON instead of tables
    std::filesystem::path file{};  // also receives the JSON; empty: no file
};
// Prints and writes the report as `to` says. The Error names the file that cannot be written.
planet::Result<void> writeReport(const ReportTo& to, const nlohmann::ordered_json& report);

}  // namespace worldy
