// worldy pops: flies a path with all loads on time, and tells how far the surface jumps at each change of
// level. Draws nothing.
#pragma once

#include <filesystem>

#include "app/view_options.h"
#include "ui/view_settings.h"

namespace worldy {

struct PopsOptions {
    std::filesystem::path file;
    std::filesystem::path flight;  // its keys
    std::filesystem::path output;  // of the report, JSON; empty: none
    int worst = 20;                // switches that are printed, >= 0; the report holds all
    double stepS = 1.0 / 60;       // of the flight's time between two frames, > 0
    PictureSize size;
    ui::ViewSettings view;
};

planet::Result<void> runPops(const PopsOptions& options);

}  // namespace worldy
