// The options that describe a view, and the settings made from them.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/settings/settings.h"
#include "planet/base/result.h"

namespace worldy {

// What a command line says of the view, each part where it was given.
struct ViewTexts {
    std::filesystem::path settingsFile;    // settings, a preset or a screenshot
    std::vector<std::string> assignments;  // "lod.tau_px=3"
    std::string size = "1280x720";
    std::string colourBy;            // one of colourByNames
    std::string surface;             // one of surfaceNames
    std::filesystem::path layerSet;  // a set of texture layers
    std::string seams;               // none, skirts or stitched
    std::optional<double> tauPx;
    std::optional<double> fovDeg;
    std::optional<int> budgetMB;
    bool noCulling = false;
    bool noSkirts = false;
    bool wireframe = false;
    bool cube = false;
};

// The defaults, changed by the settings file, then by the options with names of their own, then by the
// assignments in their order.
planet::Result<Settings> settingsFrom(const ViewTexts& texts);

}  // namespace worldy
