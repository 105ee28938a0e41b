#include "app/base/report.h"

#include <fmt/format.h>

#include <cstdio>
#include <nlohmann/json.hpp>

#include "app/base/output_file.h"

namespace worldy {

std::string jsonText(const nlohmann::ordered_json& report) {
    nlohmann::ordered_json versioned = {{"schema_version", schemaVersion}};
    versioned.update(report);
    return versioned.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

bool isCsvTable(const std::filesystem::path& file) {
    return file.extension() == ".csv";
}

planet::Result<void> writeReport(const ReportTo& to, const nlohmann::ordered_json& report) {
    if (!to.json && to.file.empty()) return {};
    const std::string text = jsonText(report);
    if (to.json) fmt::print("{}", text);
    return to.file.empty() ? planet::Result<void>() : writeTextFile(to.file, text);
}

}  // namespace worldy
