#include "app/settings/session_file.h"

#include <fmt/format.h>

#include <cfloat>
#include <sstream>
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

Result<void> readSourceEntry(const fs::path& file, std::string_view key, const toml::node& node,
                             planet::HeightSourceSettings& source) {
    const auto number = [&](std::optional<double>& value, const NumberRange& range) -> Result<void> {
        TRY_ASSIGN(value, readNumber(file, key, node, range));
        return {};
    };
    const auto integer = [&](std::optional<int>& value, const NumberRange& range) -> Result<void> {
        TRY_ASSIGN(const auto read, readInteger(file, key, node, range));
        value = static_cast<int>(read);
        return {};
    };
    const auto isOn = [&](bool& value) -> Result<void> {
        TRY_ASSIGN(value, readBool(file, key, node));
        return {};
    };
    if (key == "metres_per_unit") return number(source.metresPerUnit, {-1e6, 1e6, "m"});
    if (key == "offset_m") return number(source.offsetM, {-1e7, 1e7, "m"});
    if (key == "no_data") return number(source.noDataValue, {-DBL_MAX, DBL_MAX, ""});
    if (key == "raw_size") return integer(source.rawSize, {2, 1 << 22, "samples"});
    if (key == "raw_bits") return integer(source.rawBits, {8, 16, "bits"});
    if (key == "raw_signed") return isOn(source.rawSigned);
    if (key == "raw_big_endian") return isOn(source.rawBigEndian);
    if (key == "skip_broken") return isOn(source.skipBroken);
    if (key != "fill_m") return wrong(file, node, fmt::format("source.{} is unknown", key));
    TRY_ASSIGN(source.fillM, readNumber(file, key, node, {-1e7, 1e7, "m"}));
    return {};
}

Result<void> readSource(const fs::path& file, const toml::node& node, planet::HeightSourceSettings& source) {
    const toml::table* const table = node.as_table();
    if (!table) return wrong(file, node, "source: expected a table");
    for (const auto& [key, value] : *table) TRY(readSourceEntry(file, key.str(), value, source));
    return {};
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
    if (key == "trace_frame") {
        TRY_ASSIGN(const std::int64_t frame, readInteger(file, key, node, {0, 1e15, ""}));
        session.traceFrame = static_cast<std::uint64_t>(frame);
        return {};
    }
    if (key == "source") return readSource(file, node, session.sourceSettings);
    if (key != "file" && key != "bake" && key != "trace" && key != "trace_b" && key != "colour") {
        return wrong(file, node,
                     fmt::format("{} is unknown; expected file, bake, colour, camera, trace, trace_frame, "
                                 "trace_b, ruler, source or compare",
                                 key));
    }
    TRY_ASSIGN(const std::string text, readText(file, key, node));
    if (key == "colour")
        session.colour = text;
    else
        (key == "file"      ? session.file
         : key == "bake"    ? session.bake
         : key == "trace_b" ? session.traceB
                            : session.trace) = text;
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

namespace {

std::string sourceText(const planet::HeightSourceSettings& source) {
    std::string text;
    const auto add = [&](std::string_view key, const auto& value) {
        text += fmt::format("{} = {}\n", key, value);
    };
    // TOML's numbers with a fraction need the point.
    const auto number = [](double value) {
        std::ostringstream stream;
        stream << toml::value<double>(value);
        return stream.str();
    };
    if (source.metresPerUnit) add("metres_per_unit", number(*source.metresPerUnit));
    if (source.offsetM) add("offset_m", number(*source.offsetM));
    if (source.noDataValue) add("no_data", number(*source.noDataValue));
    if (source.fillM != 0) add("fill_m", number(source.fillM));
    if (source.rawSize) add("raw_size", *source.rawSize);
    if (source.rawBits) add("raw_bits", *source.rawBits);
    if (source.rawSigned) add("raw_signed", true);
    if (source.rawBigEndian) add("raw_big_endian", true);
    if (source.skipBroken) add("skip_broken", true);
    return text.empty() ? text : "\n[source]\n" + text;
}

}  // namespace

std::string lastSessionText(const LastSession& session) {
    std::string text = "# What Worldy goes on with when it starts without a file.\n";
    if (!session.file.empty()) text += line("file", session.file.string());
    if (!session.bake.empty()) text += line("bake", session.bake.string());
    if (session.colour) text += line("colour", session.colour->string());
    if (session.camera) text += line("camera", cameraText(*session.camera));
    if (!session.trace.empty()) text += line("trace", session.trace.string());
    if (session.traceFrame > 0) text += fmt::format("trace_frame = {}\n", session.traceFrame);
    if (!session.traceB.empty()) text += line("trace_b", session.traceB.string());
    std::vector<std::string> ends;
    for (const planet::CameraPose& end : session.ruler)
        ends.push_back(fmt::format("{},{},{}", end.latitudeDeg, end.longitudeDeg, end.altitudeM));
    if (!ends.empty()) text += line("ruler", ends);
    text += sourceText(session.sourceSettings);
    if (!session.compare) return text;
    text += "\n[compare]\n";
    if (!session.compare->file.empty()) text += line("file", session.compare->file.string());
    text += line("origin", session.compare->origin);
    text += line("settings", assignmentsFor(session.compare->settings));
    return text;
}

}  // namespace worldy
