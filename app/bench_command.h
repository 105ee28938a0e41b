// worldy bench: what LOD, streaming and the file's format cost and gain, each beside a plain way to do the
// same, paired within one run. Needs no display, but OpenGL.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "app/report.h"
#include "app/view_options.h"
#include "planet/height_source.h"

namespace worldy {

inline constexpr std::array<std::string_view, 7> benchParts = {"lod",  "dynamic",   "selection", "page_in",
                                                               "bake", "file_size", "colours"};

struct BenchOptions {
    std::filesystem::path
        source;  // an elevation image or cube faces; empty: the Earth that comes with Worldy
    planet::HeightSourceSettings sourceSettings;
    std::vector<int> faceSizes = {513, 4097};  // samples a side of the planets that are baked and drawn
    std::vector<double> tausPx = {1, 2, 4};
    int rounds = 5;  // each draws, reads or bakes everything once, in turn; [1, 1000]
    PictureSize size;
    std::vector<std::string> parts;  // of benchParts; empty: all
    ReportTo report;
};

// The Error names the source, or what the machine lacks. Bakes into a temporary folder, which is gone
// afterwards.
planet::Result<void> runBench(const BenchOptions& options);

}  // namespace worldy
