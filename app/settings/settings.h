// The settings that Worldy keeps between sessions, and the names of their enumerators.
// app/settings/settings_schema.cpp describes each setting; app/settings/settings_text.h reads and writes them
// as text.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "app/settings/view_settings.h"
#include "app/settings/workspace.h"
#include "planet/sphere/view.h"

namespace worldy {

// The names of the enumerators in files and on the command line, in the order of the enumerators.
inline constexpr std::array<std::string_view, 13> colourByNames = {
    "none",     "level",      "error",   "delta_c", "morph",  "age",  "load_order",
    "measured", "leaf_depth", "spacing", "source",  "region", "atlas"};
inline constexpr std::array<std::string_view, 2> surfaceNames = {"image", "ramp"};
inline constexpr std::array<std::string_view, 2> colourModeNames = {"tiles", "clipmap"};
inline constexpr std::array<std::string_view, 2> errorMetricNames = {"additive", "tight"};
inline constexpr std::array<std::string_view, 3> seamModeNames = {"none", "skirts", "stitched"};
inline constexpr std::array<std::string_view, 2> skirtDepthNames = {"automatic", "fixed"};
inline constexpr std::array<std::string_view, 3> prefetchModeNames = {"off", "motion", "announced"};
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
inline constexpr std::array<std::string_view, dockCount> dockNames = {"left", "right", "bottom",
                                                                      "second_window"};
inline constexpr std::array<std::string_view, 5> maximisedDockNames = {"none", "left", "right", "bottom",
                                                                       "viewport"};

struct Settings {
    std::string dataSet;
    std::string colourImage;
    ViewSettings view;
    planet::CameraPose camera{.altitudeM = 0};  // the start of a session
    int windowWidthPx = 1600;
    int windowHeightPx = 1000;
    SecondWindowPlace secondWindow{};
    Workspace workspace;
};

}  // namespace worldy
