// The command worldy cracks: counts crack pixels and pixels that skirts do not cover, in one view or along a
// flight, without a display.
#pragma once

#include <filesystem>
#include <optional>

#include "app/base/report.h"
#include "app/flight/flight_path.h"
#include "app/settings/camera_text.h"
#include "app/settings/view_settings.h"

namespace worldy {

struct CracksOptions {
    std::filesystem::path file;
    std::filesystem::path flight;  // camera keys; empty: one view
    ReportTo report;
    std::filesystem::path markedPicture;  // of the worst view by uncovered, then crack pixels; empty: none
    std::filesystem::path shaderFolder;
    std::optional<planet::CameraPose> camera;
    planet::CameraPose start{.altitudeM = 0};  // used without a camera; altitude 0: the whole planet
    FlightSampling sampling;
    bool findDepth = false;
    int worst = 20;  // number of clusters and of gaps to print, >= 0; the report contains all
    PictureSize size;
    ViewSettings view;
};

// Measures each view after all its blocks are loaded. Returns true if no pixel is uncovered.
planet::Result<bool> runCracks(const CracksOptions& options);

}  // namespace worldy
