#include "app/settings/session_file.h"

#include <fmt/format.h>

#include <sstream>
#include <string_view>

#include "app/base/places.h"
#include "app/base/toml_file.h"
#include "app/settings/camera_text.h"
#include "planet/base/try.h"

namespace worldy {

namespace {

namespace fs = std::filesystem;
using planet::Result;

Result<void> readEntry(const fs::path& file, std::string_view key, const toml::node& node,
                       LastSession& session) {
    if (key != "file" && key != "camera" && key != "trace") {
        return planet::badInput(
            fmt::format("{}: {} is unknown; expected file, camera or trace", placeOf(file, node), key));
    }
    TRY_ASSIGN(const std::string text, readText(file, key, node));
    if (key == "file") session.file = text;
    if (key == "trace") session.trace = text;
    if (key != "camera") return {};
    const Result<planet::CameraPose> pose = poseFromText(text);
    if (!pose)
        return planet::badInput(fmt::format("{}: camera: {}", placeOf(file, node), pose.error().message));
    session.camera = *pose;
    return {};
}

std::string line(std::string_view key, const std::string& text) {
    std::ostringstream quoted;
    quoted << toml::value<std::string>(text);
    return fmt::format("{} = {}\n", key, quoted.str());
}

}  // namespace

fs::path lastSessionFile() {
    return configFolder() / "session.toml";
}

Result<LastSession> loadLastSession(const fs::path& file) {
    LastSession session;
    std::error_code status;
    if (!fs::exists(file, status)) return session;
    TRY_ASSIGN(const toml::table document, parseTomlFile(file));
    for (const auto& [key, node] : document) TRY(readEntry(file, key.str(), node, session));
    return session;
}

std::string lastSessionText(const LastSession& session) {
    std::string text = "# What Worldy goes on with when it starts without a file.\n";
    if (!session.file.empty()) text += line("file", session.file.string());
    if (session.camera) text += line("camera", cameraText(*session.camera));
    if (!session.trace.empty()) text += line("trace", session.trace.string());
    return text;
}

}  // namespace worldy
