// The options of worldy bench, shared by the command and its parts.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "app/base/report.h"
#include "app/settings/camera_text.h"
#include "planet/source/height_source.h"

namespace worldy {

inline constexpr std::array<std::string_view, 10> benchParts = {
    "lod", "frame", "dynamic", "selection", "page_in", "bake", "verify", "file_size", "colours", "start"};

struct BenchOptions {
    std::filesystem::path source;  // an elevation image or cube faces; empty: the built-in Earth
    planet::HeightSourceSettings sourceSettings;
    std::vector<int> faceSizes = {513, 4097};  // samples per side of the planets baked and drawn
    std::vector<double> tausPx = {1, 2, 4};
    int rounds = 5;  // each round draws, reads or bakes everything once; [1, 1000]
    PictureSize size;
    std::vector<std::string> parts;               // elements of benchParts; empty: all
    std::vector<std::filesystem::path> compared;  // two reports to compare instead of measuring; or empty
    ReportTo report;                              // JSON, or a CSV table of the rows if the file ends in .csv
};

}  // namespace worldy
