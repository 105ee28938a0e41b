// The commands worldy info, verify and probe: show and check the content of a chunk file.
#pragma once

#include <filesystem>

#include "planet/base/result.h"
#include "planet/source/height_source.h"

namespace worldy {

struct FileCommandOptions {
    std::filesystem::path file;
    // verify: also compares with this; probe: also reads its layers; empty: only the file is read.
    std::filesystem::path source;
    planet::HeightSourceSettings sourceSettings;
    std::filesystem::path colour;  // verify: compares the colours with this; empty: does not
    double latitudeDeg = 0;        // probe
    double longitudeDeg = 0;
    bool json = false;
};

planet::Result<void> runInfo(const FileCommandOptions& options);
// Returns false if the file was read and problems were found and printed.
planet::Result<bool> runVerify(const FileCommandOptions& options);
planet::Result<void> runProbe(const FileCommandOptions& options);

}  // namespace worldy
