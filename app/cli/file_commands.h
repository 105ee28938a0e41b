// worldy info, verify and probe: what a chunk file holds.
#pragma once

#include <filesystem>

#include "planet/base/result.h"
#include "planet/source/height_source.h"

namespace worldy {

struct FileCommandOptions {
    std::filesystem::path file;
    std::filesystem::path source;  // verify: compare with this too; empty: only the file itself
    planet::HeightSourceSettings sourceSettings;
    std::filesystem::path colour;  // verify: compare the colours with this; empty: with nothing
    double latitudeDeg = 0;        // probe
    double longitudeDeg = 0;
    bool json = false;
};

planet::Result<void> runInfo(const FileCommandOptions& options);
// False: the file was read, and problems were found and printed.
planet::Result<bool> runVerify(const FileCommandOptions& options);
planet::Result<void> runProbe(const FileCommandOptions& options);

}  // namespace worldy
