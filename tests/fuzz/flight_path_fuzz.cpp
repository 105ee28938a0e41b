// Fuzzes flights as TOML: a flight that is read can be flown, and passes its keys.
#include "app/flight/flight_path_file.h"

#include <algorithm>
#include <cmath>

#include "tests/fuzz/fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using fuzz::require;
    const auto path = worldy::flightPathFromText(fuzz::textOf(data, size), "fuzzed.toml");
    if (!fuzz::isRead(path)) return 0;
    const auto [lowest, highest] = std::minmax_element(
        path->keys.begin(), path->keys.end(), [](const worldy::FlightKey& a, const worldy::FlightKey& b) {
            return a.pose.altitudeM < b.pose.altitudeM;
        });
    const double beginS = path->keys.front().timeS, lastsS = worldy::durationS(*path);
    require(path->keys.size() >= 2 && lastsS > 0, "a flight lasts");
    for (int i = -1; i <= 9; ++i) {
        const planet::CameraPose pose = poseAt(*path, beginS + lastsS * i / 8);
        require(std::abs(pose.latitudeDeg) <= 90, "latitudes lie on the planet");
        require(std::isfinite(pose.longitudeDeg) && std::isfinite(pose.headingDeg), "angles are finite");
        require(std::abs(pose.pitchDeg) <= 90 + 1e-9, "pitch overshoots no key");
        require(pose.altitudeM >= lowest->pose.altitudeM * (1 - 1e-9) &&
                    pose.altitudeM <= highest->pose.altitudeM * (1 + 1e-9),
                "altitude overshoots no key");
    }
    return 0;
}
