// The command worldy atlas: surveys a whole planet without a display, and compares a survey with an earlier one.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/base/report.h"
#include "app/settings/camera_text.h"
#include "app/settings/view_options.h"
#include "app/settings/view_settings.h"
#include "planet/measure/atlas.h"
#include "planet/measure/atlas_diff.h"

namespace worldy {

struct AtlasOptions {
    std::filesystem::path file;
    std::filesystem::path output;  // the atlas; may be empty with --diff alone
    std::filesystem::path csv;     // a table of all viewpoints; empty: none
    bool json = false;
    bool resumes = false;
    bool measuresError = false;
    bool recordsTree = true;
    int threads = 0;           // 0: one per core
    std::uint32_t listed = 5;  // viewpoints of each measure, areas and chunks
    planet::AtlasGrid grid;
    std::optional<double> diskMs{};   // latency of a read; none: that of the settings
    std::optional<double> diskMBs{};  // 10^6 bytes per second, 0 is unlimited; none: that of the settings
    PictureSize size;
    ViewSettings view;
    std::filesystem::path diff;  // an earlier atlas; empty: none
    std::vector<planet::AtlasLimit> limits;
    // The options that change settings; a survey with the settings of an earlier atlas applies them to those.
    ViewTexts changes;
};

// Returns false if a limit is exceeded.
planet::Result<bool> runAtlasCommand(const AtlasOptions& options);

}  // namespace worldy
