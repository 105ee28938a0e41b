// A flight: camera keys and a smooth path through them. Pure functions, any thread.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "planet/base/result.h"
#include "planet/sphere/view.h"

namespace worldy {

struct FlightKey {
    double timeS = 0;  // strictly increasing from key to key
    planet::CameraPose pose;
    bool jumpedTo = false;  // the camera holds the pose of the key before until timeS, then jumps here
};

struct FlightPath {
    std::string name;
    std::vector<FlightKey> keys;  // at least two
};

// Returns the unit vector from the planet's centre towards the place of a key.
glm::dvec3 directionOf(const FlightKey& key);

// Returns the seconds from the first key to the last.
double durationS(const FlightPath& path);

// Returns true if the path jumps at a time in (fromS, toS].
bool jumpsBetween(const FlightPath& path, double fromS, double toS);

// Returns the number of views of a flight, one every stepS seconds from its first key to its last. More than
// `most` views are an Error of --step-s.
planet::Result<int> flightViews(const FlightPath& path, double stepS, int most);

// The times at which a command samples a flight: either a number of frames, spread evenly from the first key
// to the last, or one frame per step. Exactly one of the two is set.
struct FlightSampling {
    std::optional<int> frames{};    // >= 1
    std::optional<double> stepS{};  // > 0
};
struct FlightFrames {
    double startS = 0;
    double stepS = 0;  // 0 if there is one frame
    int count = 1;

    double timeS(int frame) const { return startS + frame * stepS; }
};
// Chooses the frames. More than `most` frames are an Error of --frames or --step-s.
planet::Result<FlightFrames> framesOf(const FlightPath& path, const FlightSampling& sampling, int most);
// Returns `count` frames, one every stepS seconds, or evenly spread over the flight if stepS is 0.
FlightFrames framesOf(const FlightPath& path, int count, double stepS = 0);
inline constexpr int mostFlightViews = 100'000;  // most views that are settled and measured

// Returns the pose at a time, held at the ends. Over the ground it follows great-circle arcs blended to a
// smooth curve; altitude goes by its logarithm and, like heading and pitch, never overshoots a key; heading
// turns the shorter way.
planet::CameraPose poseAt(const FlightPath& path, double timeS);

}  // namespace worldy
