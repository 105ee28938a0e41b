// What Worldy remembers between sessions, and how it is read from and written to TOML. The table of all
// settings, with their ranges, is in app/settings_table.cpp.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "planet/result.h"
#include "planet/view.h"
#include "ui/editor_view.h"
#include "ui/layout.h"
#include "ui/view_settings.h"

namespace worldy {

// The names of the enumerators, in their order, in files and on the command line.
inline constexpr std::array<std::string_view, 8> colourByNames = {"none",  "level", "error",      "delta_c",
                                                                  "morph", "age",   "load_order", "measured"};
inline constexpr std::array<std::string_view, 2> surfaceNames = {"image", "ramp"};
inline constexpr std::array<std::string_view, 2> colourModeNames = {"tiles", "clipmap"};
inline constexpr std::array<std::string_view, 2> errorMetricNames = {"additive", "tight"};
inline constexpr std::array<std::string_view, 3> seamModeNames = {"none", "skirts", "stitched"};
inline constexpr std::array<std::string_view, 2> skirtDepthNames = {"automatic", "fixed"};
inline constexpr std::array<std::string_view, 3> skirtPaintNames = {"as_ground", "loud", "loud_alone"};
inline constexpr std::array<std::string_view, 4> chunkLabelsNames = {"none", "level", "error",
                                                                     "level_and_error"};
inline constexpr std::array<std::string_view, 3> cameraModeNames = {"fly", "orbit", "follow_flight"};
inline constexpr std::array<std::string_view, 3> observerModeNames = {"off", "split", "alone"};
inline constexpr std::array<std::string_view, 4> compareModeNames = {"side_by_side", "wipe", "difference",
                                                                     "flip"};
inline constexpr std::array<std::string_view, 3> featureUseNames = {"automatic", "on", "off"};
inline constexpr std::array<std::string_view, 3> layerPreviewNames = {"off", "heat", "mask"};
inline constexpr std::array<std::string_view, 2> themeNames = {"dark", "light"};
inline constexpr std::array<std::string_view, 3> dockNames = {"left", "right", "bottom"};

struct Settings {
    std::string dataSet;      // chunk file, elevation image or faces to open; empty: the Earth
    std::string colourImage;  // picture laid over it; empty: colour.jpg or colour.png beside the data set
    ui::ViewSettings view;
    planet::CameraPose camera{.altitudeM =
                                  0};  // where a session starts; altitude 0: the whole planet in view
    int windowWidthPx = 1600;          // [640, 16384]
    int windowHeightPx = 1000;         // [400, 16384]
    ui::Workspace workspace;
};

// Whether every setting is the same.
bool operator==(const Settings& a, const Settings& b);

// Missing keys keep what base has. Keys that older versions wrote are understood. The Error names the file,
// the line, the key and what would be right.
planet::Result<Settings> loadSettings(const std::filesystem::path& file, const Settings& base = {});
// The same of text; place stands for the file's name in errors.
planet::Result<Settings> settingsFromText(std::string_view text, const std::filesystem::path& place,
                                          const Settings& base = {});

// The file's text: every setting with a sentence that explains it. Equal settings give equal text. Colours
// are kept in steps of 1 / 255.
std::string settingsText(const Settings& settings);

planet::Result<void> saveSettings(const Settings& settings, const std::filesystem::path& file);

// Sets one: "lod.tau_px=3", "surface.colour=ramp", texts with or without quotes. The Error names the setting
// or the nearest one, and what would be right; then nothing has changed.
planet::Result<void> setSetting(Settings& settings, std::string_view assignment);

// Where the view settings differ, as text: "lod.tau_px", "2", "3".
std::vector<ui::SettingDifference> differences(const Settings& here, const Settings& there);

// What setSetting would have to be told to get these view settings from the defaults.
std::vector<std::string> assignmentsFor(const ui::ViewSettings& view);

// A preset's file holds view settings, all of them or a few.
struct ViewPart {
    ui::ViewSettings values;
    std::vector<std::string> names;  // of the settings that it holds, "lod.tau_px"
};
// Every view setting. Equal settings give equal text.
std::string viewSettingsText(const ui::ViewSettings& view);
// Other settings in the file are checked but left out: a settings file serves too.
planet::Result<ViewPart> loadViewPart(const std::filesystem::path& file);
// The same of text; place stands for the file's name in errors.
planet::Result<ViewPart> viewPartFromText(std::string_view text, const std::filesystem::path& place);
// The settings as they are, but for what the part holds.
ui::ViewSettings applied(const ViewPart& part, const ui::ViewSettings& now);
// Where that would change something.
std::vector<ui::SettingDifference> differences(const ui::ViewSettings& here, const ViewPart& there);

// What a preset's file makes of the settings as they are.
planet::Result<ui::ViewSettings> loadViewSettings(const std::filesystem::path& file,
                                                  const ui::ViewSettings& now = {});

}  // namespace worldy
