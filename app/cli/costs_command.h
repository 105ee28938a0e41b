// worldy costs: what each part of a picture costs, without a display.
#pragma once

#include <filesystem>
#include <optional>

#include "app/base/report.h"
#include "app/settings/camera_text.h"
#include "app/settings/view_settings.h"

namespace worldy {

struct CostsOptions {
    std::filesystem::path file;
    std::filesystem::path colourImage;  // empty: beside the file, if there is one
    std::optional<planet::CameraPose> camera;
    planet::CameraPose start{.altitudeM = 0};  // where no camera is given; altitude 0: the whole planet
    PictureSize size;
    int rounds = 5;
    ReportTo report;
    ViewSettings view;
};

// Prints a table, and writes it as JSON where told.
planet::Result<void> runCosts(const CostsOptions& options);

}  // namespace worldy
