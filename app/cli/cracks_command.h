// worldy cracks: counts crack pixels and what the skirts leave open, in one view or along a flight, without a
// display.
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
    std::filesystem::path flight;  // its keys; empty: one view
    ReportTo report;
    std::filesystem::path markedPicture;  // of the view that leaks most, else cracks most; empty: none
    std::filesystem::path shaderFolder;
    std::optional<planet::CameraPose> camera;
    planet::CameraPose start{.altitudeM = 0};  // where no camera is given; altitude 0: the whole planet
    FlightSampling sampling;
    bool findDepth = false;
    int worst = 20;  // clusters and gaps that are printed, of each so many, >= 0; the report holds all
    PictureSize size;
    ViewSettings view;
};

// Each view is measured once everything for it is loaded. True: nothing leaks.
planet::Result<bool> runCracks(const CracksOptions& options);

}  // namespace worldy
