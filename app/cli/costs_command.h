// The command worldy costs: measures the cost of each rendering feature, without a display.
#pragma once

#include <filesystem>
#include <optional>

#include "app/base/report.h"
#include "app/settings/camera_text.h"
#include "app/settings/view_settings.h"

namespace worldy {

struct CostsOptions {
    std::filesystem::path file;
    std::filesystem::path colourImage;  // empty: the one beside the file, if there is one
    std::optional<planet::CameraPose> camera;
    planet::CameraPose start{.altitudeM = 0};  // used without a camera; altitude 0: the whole planet
    PictureSize size;
    int rounds = 5;
    ReportTo report;
    ViewSettings view;
};

// Prints a table, and writes JSON if requested.
planet::Result<void> runCosts(const CostsOptions& options);

}  // namespace worldy
