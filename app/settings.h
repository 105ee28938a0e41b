// What Worldy remembers between sessions, and how it is read from and written to a TOML file.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <string_view>

#include "planet/result.h"
#include "planet/view.h"
#include "ui/layout.h"
#include "ui/view_settings.h"

namespace worldy {

// The names of the enumerators, in their order, in files and on the command line.
inline constexpr std::array<std::string_view, 3> colourByNames = {"none", "level", "error"};
inline constexpr std::array<std::string_view, 2> surfaceNames = {"image", "ramp"};

struct Settings {
    std::string dataSet;      // chunk file, elevation image or faces to open; empty: the Earth
    std::string colourImage;  // picture laid over it; empty: colour.jpg or colour.png beside the data set
    ui::ViewSettings view;
    planet::CameraPose camera{.altitudeM =
                                  0};  // where a session starts; altitude 0: the whole planet in view
    int windowWidthPx = 1600;          // [640, 16384]
    int windowHeightPx = 1000;         // [400, 16384]
    ui::PanelSizes panels;
};

// Missing keys keep their defaults. The Error names the file, the line, the key and what would be right.
planet::Result<Settings> loadSettings(const std::filesystem::path& file);

// The file's text: every setting with a sentence that explains it. Equal settings give equal text.
std::string settingsText(const Settings& settings);

planet::Result<void> saveSettings(const Settings& settings, const std::filesystem::path& file);

}  // namespace worldy
