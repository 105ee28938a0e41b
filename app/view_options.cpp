#include "app/view_options.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

#include "app/layer_file.h"
#include "app/screenshot.h"

namespace worldy {

namespace {

// Numbers between separators; nothing where one of them is none.
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
        return planet::badInput(fmt::format(
            "--size: {} is no size; expected WIDTHxHEIGHT with 16 to 16384 pixels a side, as 1280x720",
            text));
    }
    return PictureSize{static_cast<int>((*sides)[0]), static_cast<int>((*sides)[1])};
}

planet::Result<Pose> poseFromText(const std::string& text) {
    const std::optional<std::vector<double>> numbers = numbersIn(text, ',');
    if (!numbers || numbers->size() < 3 || numbers->size() > poseNumbers.size()) {
        return planet::badInput(
            fmt::format("--camera: {} is no camera; expected LAT,LON,ALT,HEADING,PITCH in degrees and "
                        "metres, as 28,86,20000,0,-20",
                        text));
    }
    Pose pose;
    for (std::size_t i = 0; i < numbers->size(); ++i) {
        const PoseNumber& field = poseNumbers[i];
        if ((*numbers)[i] < field.min || (*numbers)[i] > field.max) {
            return planet::badInput(fmt::format("--camera: {} is {}; expected {} to {}", field.name,
                                                (*numbers)[i], field.min, field.max));
        }
        pose.*field.value = (*numbers)[i];
    }
    return pose;
}

planet::Result<Settings> settingsFrom(const ViewTexts& texts) {
    Settings settings;
    if (!texts.settingsFile.empty()) {
        planet::Result<Settings> loaded = loadSettingsOfAnyKind(texts.settingsFile);
        if (!loaded) return loaded;
        settings = std::move(*loaded);
    }
    ui::ViewSettings& view = settings.view;
    view.lod.tauPx = texts.tauPx.value_or(view.lod.tauPx);
    view.camera.fovDeg = texts.fovDeg.value_or(view.camera.fovDeg);
    view.paging.budgetMB = texts.budgetMB.value_or(view.paging.budgetMB);
    if (texts.noCulling) view.lod.frustumCulling = view.lod.horizonCulling = false;
    if (texts.noSkirts) view.seams.mode = planet::SeamMode::None;
    if (texts.wireframe) view.overlay.wireframe = true;
    if (texts.cube) view.overlay.cube = true;
    if (!texts.layerSet.empty()) {
        planet::Result<planet::LayerSet> set = loadLayerSet(texts.layerSet);
        if (!set) return tl::unexpected(set.error());
        view.surface.layers.set = std::move(*set);
        // A picture's note of it must hold wherever it is read.
        std::error_code status;
        view.surface.layers.file = std::filesystem::absolute(texts.layerSet, status).string();
    }
    std::vector<std::string> assignments;
    if (!texts.colourBy.empty()) assignments.push_back("overlay.colour_by=" + texts.colourBy);
    if (!texts.surface.empty()) assignments.push_back("surface.colour=" + texts.surface);
    if (!texts.seams.empty()) assignments.push_back("seams.mode=" + texts.seams);
    assignments.insert(assignments.end(), texts.assignments.begin(), texts.assignments.end());
    for (const std::string& assignment : assignments) {
        if (const planet::Result<void> set = setSetting(settings, assignment); !set)
            return planet::badInput("--set " + set.error().message);
    }
    return settings;
}

}  // namespace worldy
