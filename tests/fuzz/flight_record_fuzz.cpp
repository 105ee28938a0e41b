// Fuzzes recorded flights. An input is a file or, if it does not begin as one, the content of a file, because
// compression and the checksum would stop most inputs.
#include "app/flight/flight_record.h"

#include <cmath>

#include "app/flight/flight_path_file.h"
#include "tests/fuzz/fuzz.h"

namespace {

using namespace worldy;
using fuzz::isRead;
using fuzz::require;

void checkRecord(const FlightRecord& record) {
    require(!record.frames.empty() && record.frames.size() <= maxFlightFrames, "the frames are limited");
    for (const FlightFrame& frame : record.frames) {
        require(!frame.views.empty() && frame.views.size() <= planet::maxViews, "each frame has views");
        require(frame.elapsedS >= 0 && frame.elapsedS <= maxFlightS, "time goes on");
    }
    const auto path = pathOf(record, "fuzzed.flight");
    if (!isRead(path)) return;
    for (int i = 0; i <= 8; ++i) {
        const planet::CameraPose pose = poseAt(*path, path->keys.front().timeS + durationS(*path) * i / 8);
        require(std::isfinite(pose.latitudeDeg) && std::isfinite(pose.longitudeDeg) &&
                    std::isfinite(pose.headingDeg) && std::isfinite(pose.pitchDeg),
                "angles are finite");
        require(std::isfinite(pose.altitudeM) && pose.altitudeM > 0, "cameras stay above the ground");
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto bytes = fuzz::bytesOf(data, size);
    const bool isFile = fuzz::textOf(data, size).starts_with("WYFLIGHT");
    constexpr int fastest = 1;
    const auto sealed =
        isFile ? std::vector(bytes.begin(), bytes.end()) : flightFileBytes(bytes, fastest).value();
    const auto record = flightRecordFromBytes(sealed, "fuzzed.flight");
    if (isRead(record)) checkRecord(*record);
    return 0;
}
