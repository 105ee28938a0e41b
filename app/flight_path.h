// A recorded flight: camera keys in a TOML file, and a smooth way through them. Pure but for the reading.
//
//     name = "Orbit to ground"
//     [[key]]
//     time_s = 0
//     latitude_deg = 20
//     longitude_deg = 60
//     altitude_m = 1.2e7     # above the planet's radius
//     heading_deg = 0
//     pitch_deg = -90
#pragma once

#include <filesystem>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "planet/result.h"
#include "planet/view.h"

namespace worldy {

struct FlightKey {
    double timeS = 0;  // strictly increasing from key to key
    planet::CameraPose pose;
    bool jumpedTo =
        false;  // the pose of the key before is held until then, and the camera is put here at once
};

struct FlightPath {
    std::string name;
    std::vector<FlightKey> keys;  // at least two
};

// Also the way of a recorded .flight (app/flight_record.h). The Error names the file, the key's number from 1
// and what would be right.
planet::Result<FlightPath> loadFlightPath(const std::filesystem::path& file);
// The same of a TOML file's text; place stands for the file's name in errors.
planet::Result<FlightPath> flightPathFromText(std::string_view text, const std::filesystem::path& place);

double durationS(const FlightPath& path);

// Whether a camera comes from one place to another faster than any flight: within a tenth of a second over 5
// degrees of arc, ten times as high or as low, or ten times as far as it is high. Close to the ground its
// height says little. Eyes: metres from the planet's centre; seconds >= 0.
bool isCameraJump(const glm::dvec3& fromM, const glm::dvec3& toM, double radiusM, double seconds);
// Whether the path puts the camera elsewhere at once at a time in (fromS, toS].
bool jumpsBetween(const FlightPath& path, double fromS, double toS);

// How many views a flight has, one every so many seconds from its first key to its last. The Error is that of
// --step-s: more than most of them.
planet::Result<int> flightViews(const FlightPath& path, double stepS, int most);

// Where along a flight a command looks: at so many frames, evenly spread from the first key to the last, or
// at one every so many seconds. One of the two is given.
struct FlightSampling {
    std::optional<int> frames{};    // >= 1
    std::optional<double> stepS{};  // > 0
};
struct FlightFrames {
    double startS = 0;
    double stepS = 0;  // 0 where there is one frame
    int count = 1;

    double timeS(int frame) const { return startS + frame * stepS; }
};
// The Error is that of --frames or --step-s: more than most frames.
planet::Result<FlightFrames> framesOf(const FlightPath& path, const FlightSampling& sampling, int most);
FlightFrames evenFrames(const FlightPath& path, int count);
inline constexpr int mostFlightViews = 100'000;  // each of which is settled and measured

// The pose at a time, held at the ends. Over the ground it follows great-circle arcs blended to a smooth
// curve; altitude goes by its logarithm and, like heading and pitch, never overshoots a key; heading turns
// the shorter way.
planet::CameraPose poseAt(const FlightPath& path, double timeS);

}  // namespace worldy
