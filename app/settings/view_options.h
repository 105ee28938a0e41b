// The options that describe a view, and the settings made from them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/settings/settings.h"
#include "planet/base/result.h"

namespace worldy {

// The options of a command line that describe the view, unparsed.
struct ViewTexts {
    std::filesystem::path settingsFile;  // settings, a preset or a screenshot
    std::vector<std::string>
        options;  // assignments of options with names of their own: --tau 3, "lod.tau_px=3"
    std::vector<std::string> assignments;  // --set lod.tau_px=3, "lod.tau_px=3"
    std::string size = "1280x720";
    std::filesystem::path layerSet;  // a set of texture layers
    std::filesystem::path regions;   // a file of regions; empty: the one beside the planet, if there is one
};

// Returns the defaults, changed by the settings file, then by the options with their own names, then by the
// assignments in their order.
planet::Result<Settings> settingsFrom(const ViewTexts& texts);

}  // namespace worldy
