#include "app/settings/camera_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>
#include <vector>

namespace worldy {

namespace {

// Returns the numbers between separators, or nothing if one of them is no number.
std::optional<std::vector<double>> numbersIn(std::string_view text, char separator) {
    std::vector<double> numbers;
    for (;;) {
        const std::size_t end = std::min(text.find(separator), text.size());
        double value = 0;
        const auto [rest, problem] = std::from_chars(text.data(), text.data() + end, value);
        if (problem != std::errc{} || rest != text.data() + end || !std::isfinite(value)) return std::nullopt;
        numbers.push_back(value);
        if (end == text.size()) return numbers;
        text.remove_prefix(end + 1);
    }
}

struct PoseNumber {
    std::string_view name;
    double planet::CameraPose::*value;
    double min;
    double max;
};

using Pose = planet::CameraPose;
constexpr std::array<PoseNumber, 5> poseNumbers = {{
    {"latitude", &Pose::latitudeDeg, -90, 90},
    {"longitude", &Pose::longitudeDeg, -360, 360},
    {"altitude", &Pose::altitudeM, -1e6, 2e10},
    {"heading", &Pose::headingDeg, -360, 360},
    {"pitch", &Pose::pitchDeg, -90, 90},
}};

}  // namespace

planet::Result<PictureSize> pictureSizeFromText(const std::string& text) {
    const std::optional<std::vector<double>> sides = numbersIn(text, 'x');
    const auto good = [](double side) { return side >= 16 && side <= 16384 && side == std::floor(side); };
    if (!sides || sides->size() != 2 || !good((*sides)[0]) || !good((*sides)[1])) {
        return planet::badInput(
            fmt::format("--size: {} is not a size; expected WIDTHxHEIGHT in pixels, each in [16, 16384], for "
                        "example 1280x720",
                        text));
    }
    return PictureSize{static_cast<int>((*sides)[0]), static_cast<int>((*sides)[1])};
}

planet::Result<Pose> poseFromText(const std::string& text) {
    const std::optional<std::vector<double>> numbers = numbersIn(text, ',');
    if (!numbers || numbers->size() < 3 || numbers->size() > poseNumbers.size()) {
        return planet::badInput(
            fmt::format("--camera: {} is not a camera; expected LAT,LON,ALT,HEADING,PITCH in degrees and "
                        "metres, for example 28,86,20000,0,-20",
                        text));
    }
    Pose pose;
    for (std::size_t i = 0; i < numbers->size(); ++i) {
        const PoseNumber& field = poseNumbers[i];
        if ((*numbers)[i] < field.min || (*numbers)[i] > field.max) {
            return planet::badInput(fmt::format("--camera: {} is {}; expected [{}, {}]", field.name,
                                                (*numbers)[i], field.min, field.max));
        }
        pose.*field.value = (*numbers)[i];
    }
    return pose;
}

std::string cameraText(const planet::CameraPose& pose) {
    return fmt::format("{},{},{},{},{}", pose.latitudeDeg, pose.longitudeDeg, pose.altitudeM, pose.headingDeg,
                       pose.pitchDeg);
}

planet::CameraPose roundedPose(const planet::CameraPose& pose) {
    const auto degrees = [](double value) { return std::round(value * 1e9) / 1e9 + 0.0; };  // no -0
    const double headingDeg = degrees(pose.headingDeg);
    return {.latitudeDeg = degrees(pose.latitudeDeg),
            .longitudeDeg = degrees(pose.longitudeDeg),
            .altitudeM = std::round(pose.altitudeM * 1e6) / 1e6,
            .headingDeg = headingDeg == 360 ? 0 : headingDeg,
            .pitchDeg = degrees(pose.pitchDeg)};
}

}  // namespace worldy
