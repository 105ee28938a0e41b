#include "app/flight/flight_path_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <string>
#include <vector>

#include "app/base/output_file.h"
#include "app/base/toml_file.h"

namespace worldy {

namespace {

namespace fs = std::filesystem;
using planet::Result;
using Pose = planet::CameraPose;

struct KeyField {
    std::string_view name;
    double FlightKey::*time;
    double planet::CameraPose::*pose;
    NumberRange range;
};

constexpr std::array<KeyField, 6> keyFields = {{
    {"time_s", &FlightKey::timeS, nullptr, {0, 1e6, "s"}},
    {"latitude_deg", nullptr, &Pose::latitudeDeg, {-90, 90, "°"}},
    {"longitude_deg", nullptr, &Pose::longitudeDeg, {-360, 360, "°"}},
    {"altitude_m", nullptr, &Pose::altitudeM, {1, 2e10, "m"}},
    {"heading_deg", nullptr, &Pose::headingDeg, {-360, 360, "°"}},
    {"pitch_deg", nullptr, &Pose::pitchDeg, {-90, 90, "°"}},
}};

Result<FlightKey> readKey(const fs::path& file, std::size_t number, const toml::table& table) {
    FlightKey key;
    for (const KeyField& field : keyFields) {
        const std::string name = fmt::format("key {}: {}", number, field.name);
        const toml::node* node = table.get(field.name);
        if (!node) {
            return planet::badInput(fmt::format("{}: {} is missing; expected a number in {}",
                                                placeOf(file, table), name, textOf(field.range)));
        }
        const Result<double> value = readNumber(file, name, *node, field.range);
        if (!value) return tl::unexpected(value.error());
        (field.time ? key.*field.time : key.pose.*field.pose) = *value;
    }
    for (const auto& [name, node] : table) {
        const std::string_view unknown = name.str();
        if (unknown == "jump") {
            const Result<bool> jump = readBool(file, fmt::format("key {}: jump", number), node);
            if (!jump) return tl::unexpected(jump.error());
            key.jumpedTo = *jump;
            continue;
        }
        if (std::any_of(keyFields.begin(), keyFields.end(),
                        [&](const KeyField& field) { return field.name == unknown; })) {
            continue;
        }
        return planet::badInput(fmt::format(
            "{}: key {}: {:.40} is unknown; expected time_s, latitude_deg, longitude_deg, altitude_m, "
            "heading_deg, pitch_deg and, optionally, jump",
            placeOf(file, node), number, name.str()));
    }
    return key;
}

// The great circle between opposite places is undefined, and it is unstable close to that.
constexpr double maxStepDeg = 170;

Result<void> checkOrder(const fs::path& file, const toml::table& table, const FlightPath& path,
                        const FlightKey& next) {
    if (path.keys.empty()) {
        if (!next.jumpedTo) return {};
        return planet::badInput(fmt::format("{}: key 1: jump is true without a key before it; expected false",
                                            placeOf(file, table)));
    }
    const std::size_t number = path.keys.size() + 1;
    const FlightKey& last = path.keys.back();
    if (next.timeS <= last.timeS) {
        return planet::badInput(fmt::format("{}: key {}: time_s is {}; expected a time after key {}'s {}",
                                            placeOf(file, table), number, next.timeS, number - 1,
                                            last.timeS));
    }
    const double cosine = glm::dot(directionOf(last), directionOf(next));
    const double stepDeg = glm::degrees(std::acos(std::clamp(cosine, -1.0, 1.0)));
    if (stepDeg > maxStepDeg && !next.jumpedTo) {
        return planet::badInput(fmt::format(
            "{}: key {}: is {:.0f}° from key {}; expected at most {}° between keys, or jump = true",
            placeOf(file, table), number, stepDeg, number - 1, maxStepDeg));
    }
    return {};
}

Result<void> readKeys(const fs::path& file, const toml::array& keys, FlightPath& path) {
    for (const toml::node& node : keys) {
        const std::size_t number = path.keys.size() + 1;
        const toml::table* table = node.as_table();
        if (!table) {
            return planet::badInput(
                fmt::format("{}: key {} is not a table; expected [[key]]", placeOf(file, node), number));
        }
        const Result<FlightKey> key = readKey(file, number, *table);
        if (!key) return tl::unexpected(key.error());
        if (Result<void> order = checkOrder(file, *table, path, *key); !order) return order;
        path.keys.push_back(*key);
    }
    return {};
}

Result<FlightPath> flightPathOf(const fs::path& file, const toml::table& document) {
    FlightPath path;
    for (const auto& [key, node] : document) {
        if (key.str() == "name") {
            const Result<std::string> name = readText(file, "name", node);
            if (!name) return tl::unexpected(name.error());
            path.name = *name;
        } else if (key.str() == "key" && node.is_array()) {
            if (Result<void> read = readKeys(file, *node.as_array(), path); !read)
                return tl::unexpected(read.error());
        } else {
            return planet::badInput(fmt::format("{}: {:.40} is unknown; expected name and [[key]] tables",
                                                placeOf(file, node), key.str()));
        }
    }
    if (path.keys.size() < 2) {
        return planet::badInput(
            fmt::format("{}: has {} [[key]] tables; expected two or more", file.string(), path.keys.size()));
    }
    return path;
}

constexpr double leastGapS = 0.1;

planet::CameraPose flownPose(const FlightRecord& record, std::size_t frame) {
    planet::CameraPose pose =
        planet::poseFromView(record.frames[frame].views[0].view, record.data.shape.radiusM);
    pose.altitudeM = std::max(pose.altitudeM, 1.0);  // the lowest altitude of a flight
    return pose;
}

bool isJump(const FlightRecord& record, std::size_t frame) {
    if (frame == 0) return false;
    const auto eyeM = [&](std::size_t i) { return record.frames[i].views[0].view.eyeM; };
    return planet::isCameraJump(eyeM(frame - 1), eyeM(frame), record.data.shape.radiusM,
                                record.frames[frame].elapsedS);
}

}  // namespace

Result<FlightPath> pathOf(const FlightRecord& record, const fs::path& file) {
    FlightPath path;
    path.name = record.name;
    std::vector<FlightKey>& keys = path.keys;
    const auto isLater = [&](double timeS) { return keys.empty() || timeS > keys.back().timeS; };
    double timeS = 0;
    bool jumped = false;  // since the last key
    for (std::size_t i = 0; i < record.frames.size(); ++i) {
        if (isJump(record, i)) {
            if (!jumped && isLater(timeS)) keys.push_back({timeS, flownPose(record, i - 1)});
            jumped = true;
        }
        timeS += record.frames[i].elapsedS;
        const bool last = i + 1 == record.frames.size();
        const bool due =
            keys.empty() || jumped || timeS - keys.back().timeS >= leastGapS || (last && keys.size() == 1);
        if (!due || !isLater(timeS)) continue;
        keys.push_back({timeS, flownPose(record, i), jumped});
        jumped = false;
    }
    if (keys.size() >= 2) return path;
    return planet::badInput(fmt::format("{}: has 1 frame; expected at least 2", file.string()));
}

Result<FlightPath> loadFlightPath(const fs::path& file) {
    if (isFlightRecord(file)) {
        return loadFlightRecord(file).and_then(
            [&](const FlightRecord& record) { return pathOf(record, file); });
    }
    // Text contains no NUL.
    if (startOfFile(file, 4096).find('\0') != std::string::npos) {
        return planet::badInput(
            fmt::format("{}: is not a flight; expected a flight (.toml or .flight)", file.string()));
    }
    return parseTomlFile(file).and_then(
        [&](const toml::table& document) { return flightPathOf(file, document); });
}

Result<FlightPath> flightPathFromText(std::string_view text, const fs::path& place) {
    return parseTomlText(text, place).and_then([&](const toml::table& document) {
        return flightPathOf(place, document);
    });
}

}  // namespace worldy
