// The window goes on with this at its next start without a file. The layout and all settings are in the settings file.
//
//     file = "/terrain/alps.tif"                          # the planet that was shown
//     camera = "46.4,6.9,6000,180,-10"                     # latitude, longitude, altitude in metres, heading, pitch
//     trace = "/traces/engine.lodtrace"                    # the open trace
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "planet/base/result.h"
#include "planet/sphere/view.h"

namespace worldy {

struct LastSession {
    std::filesystem::path file{};  // a source or a chunk file; empty: the planet that comes with Worldy
    std::optional<planet::CameraPose> camera{};
    std::filesystem::path trace{};  // empty: none
};

// Returns configFolder()/session.toml.
std::filesystem::path lastSessionFile();

// A file that does not exist is an empty session. The Error names the file, the line and what is expected.
planet::Result<LastSession> loadLastSession(const std::filesystem::path& file);
// Returns the text of a session's file. Two sessions are the same if their texts are.
std::string lastSessionText(const LastSession& session);

}  // namespace worldy
