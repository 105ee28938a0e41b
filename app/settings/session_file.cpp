#include "app/settings/session_file.h"

#include <fmt/format.h>

#include <string_view>
#include <vector>

#include "app/base/places.h"
#include "app/base/toml_file.h"
#include "app/settings/camera_text.h"
#include "app/settings/settings_text.h"
#include "planet/base/try.h"

namespace worldy {

namespace {

namespace fs = std::filesystem;
using planet::Result;

Result<planet::CameraPose> readPose(const fs::path& file, std::string_view key, const toml::node& node) {
    TRY_ASSIGN(const std::string text, readText(file, key, node));
    const Result<planet::CameraPose> pose = poseFromText(text);
    if (!pose) return wrong(file, node, fmt::format("{}: {}", key, pose.error().message));
    return *pose;
}

Result<void> readRuler(const fs::path& file, const toml::node& node, LastSession& session) {
    const toml::array* const ends = node.as_array();
    if (!ends || ends->size() > 2) return wrong(file, node, "ruler: expected a list of at most two places");
    for (const toml::node& end : *ends) {
        TRY_ASSIGN(const planet::CameraPose place, readPose(file, "ruler", end));
        session.ruler.push_back(place);
    }
    return {};
}

Result<ViewSettings> readAssignments(const fs::path& file, const toml::node& node) {
    const toml::array* const assignments = node.as_array();
    if (!assignments) return wrong(file, node, "settings: expected a list such as [\"lod.tau_px=3\"]");
    Settings settings;
    for (const toml::node& one : *assignments) {
        TRY_ASSIGN(const std::string assignment, readText(file, "settings", one));
        const Result<void> set = setSetting(settings, assignment);
        if (!set) return wrong(file, one, set.error().message);
    }
    return settings.view;
}

Result<LastComparison> readComparison(const fs::path& file, const toml::node& node) {
    const toml::table* const table = node.as_table();
    if (!table) return wrong(file, node, "compare: expected a table");
    LastComparison compare;
    for (const auto& [key, value] : *table) {
        if (key == "settings") {
            TRY_ASSIGN(compare.settings, readAssignments(file, value));
            continue;
        }
        if (key != "file" && key != "origin") {
            return wrong(file, value,
                         fmt::format("compare.{} is unknown; expected file, origin or settings", key.str()));
        }
        TRY_ASSIGN(const std::string text, readText(file, key.str(), value));
        if (key == "file")
            compare.file = text;
        else
            compare.origin = text;
    }
    return compare;
}

Result<void> readEntry(const fs::path& file, std::string_view key, const toml::node& node,
                       LastSession& session) {
    if (key == "ruler") return readRuler(file, node, session);
    if (key == "camera") {
        TRY_ASSIGN(session.camera, readPose(file, key, node));
        return {};
    }
    if (key == "compare") {
        TRY_ASSIGN(session.compare, readComparison(file, node));
        return {};
    }
    if (key != "file" && key != "bake" && key != "trace") {
        return wrong(file, node,
                     fmt::format("{} is unknown; expected file, bake, camera, trace, ruler or compare", key));
    }
    TRY_ASSIGN(const std::string text, readText(file, key, node));
    (key == "file" ? session.file : key == "bake" ? session.bake : session.trace) = text;
    return {};
}

std::string line(std::string_view key, const std::string& text) {
    return fmt::format("{} = {}\n", key, tomlText(text));
}

std::string line(std::string_view key, const std::vector<std::string>& texts) {
    std::string list;
    for (const std::string& text : texts) list += (list.empty() ? "" : ", ") + tomlText(text);
    return fmt::format("{} = [{}]\n", key, list);
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
    if (!session.bake.empty()) text += line("bake", session.bake.string());
    if (session.camera) text += line("camera", cameraText(*session.camera));
    if (!session.trace.empty()) text += line("trace", session.trace.string());
    std::vector<std::string> ends;
    for (const planet::CameraPose& end : session.ruler)
        ends.push_back(fmt::format("{},{},{}", end.latitudeDeg, end.longitudeDeg, end.altitudeM));
    if (!ends.empty()) text += line("ruler", ends);
    if (!session.compare) return text;
    text += "\n[compare]\n";
    if (!session.compare->file.empty()) text += line("file", session.compare->file.string());
    text += line("origin", session.compare->origin);
    text += line("settings", assignmentsFor(session.compare->settings));
    return text;
}

}  // namespace worldy
