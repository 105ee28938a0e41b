// The window goes on with this at its next start without a file. The layout and all settings are in the settings file.
//
//     file = "/terrain/alps.tif"                   # the planet that was shown
//     bake = "/cache/alps-33.chk"                   # its chunk file, which the source's default bake need not be
//     colour = "/terrain/alps.jpg"                  # the image of its colour tiles; empty: it has none
//     camera = "46.4,6.9,6000,180,-10"              # latitude, longitude, altitude in metres, heading, pitch
//     trace = "/traces/engine.lodtrace"             # the open trace
//     trace_frame = 198                             # that was shown
//     trace_b = "/traces/after.lodtrace"            # the trace that it was compared with
//     ruler = ["46.4,6.9,410", "46.5,7.1,2200"]     # the ends: latitude, longitude, altitude in metres
//     [source]                                      # how the source is read, where it is not the default: the names
//     metres_per_unit = 0.3048                      # of the command line's options
//     [compare]                                     # B, if two planets were compared
//     file = "/terrain/alps_33.chk"                 # only if it was another file than A's
//     origin = "preset popping"
//     settings = ["lod.tau_px=3"]                   # those that are not the default
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/settings/view_settings.h"
#include "planet/base/result.h"
#include "planet/raster/height_source_settings.h"
#include "planet/sphere/view.h"

namespace worldy {

struct LastComparison {
    std::filesystem::path file{};  // empty: the file of the shown planet
    std::string origin{};          // "snapshot", "preset popping"
    ViewSettings settings{};       // of B
};

struct LastSession {
    std::filesystem::path file{};  // a source or a chunk file; empty: the planet that comes with Worldy
    std::filesystem::path bake{};  // the chunk file of a source; empty: the one that the source opens
    planet::HeightSourceSettings sourceSettings{};
    std::optional<std::filesystem::path> colour{};  // not given: the image beside the source
    std::optional<planet::CameraPose> camera{};
    std::filesystem::path trace{};   // empty: none
    std::uint64_t traceFrame = 0;    // that was shown; 0: not known
    std::filesystem::path traceB{};  // that the trace was compared with; empty: none
    std::vector<planet::CameraPose>
        ruler{};  // the places of its ends, at most two; their directions mean nothing
    std::optional<LastComparison> compare{};
};

// Returns configFolder()/session.toml.
std::filesystem::path lastSessionFile();

// A file that does not exist is an empty session. The Error names the file, the line and what is expected.
planet::Result<LastSession> loadLastSession(const std::filesystem::path& file);
// Returns the text of a session's file. Two sessions are the same if their texts are.
std::string lastSessionText(const LastSession& session);

}  // namespace worldy
