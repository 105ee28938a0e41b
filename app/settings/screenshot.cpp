#include "app/settings/screenshot.h"

#include <fmt/format.h>

#include <array>
#include <fstream>
#include <vector>

#include "app/base/new_file.h"
#include "app/base/picture_file.h"
#include "app/base/places.h"
#include "app/settings/camera_text.h"
#include "app/settings/settings_text.h"

namespace worldy {

namespace {

namespace fs = std::filesystem;
using planet::Result;

constexpr const char* settingsKeyword = "worldy:settings";
constexpr const char* cameraKeyword = "worldy:camera";
constexpr const char* dataSetKeyword = "worldy:data";
constexpr const char* shotLineKeyword = "worldy:shot";
constexpr const char* versionKeyword = "worldy:version";

}  // namespace

Result<void> writeScreenshot(const Picture& picture, const fs::path& file, const ScreenshotNote& note) {
    const std::string version = note.version.empty() ? WORLDY_VERSION : note.version;
    std::vector<PictureText> texts = {{"Software", "Worldy " + version},
                                      {"ImageDescription", note.shotLine},
                                      {settingsKeyword, note.settings},
                                      {cameraKeyword, cameraText(note.camera)},
                                      {dataSetKeyword, note.dataSet.string()},
                                      {shotLineKeyword, note.shotLine},
                                      {versionKeyword, version}};
    std::erase_if(texts, [](const PictureText& text) { return text.text.empty(); });
    return writePicture(picture, file, texts);
}

Result<fs::path> writeNewScreenshot(const Picture& picture, const ScreenshotNote& note) {
    Result<fs::path> file = newScreenshotFile(picturesFolder(), localTimeNow());
    if (!file) return file;
    if (const Result<void> written = writeScreenshot(picture, *file, note); !written) {
        std::error_code status;
        fs::remove(*file, status);
        return tl::unexpected(written.error());
    }
    return file;
}

Result<ScreenshotNote> readScreenshotNote(const fs::path& file) {
    ScreenshotNote note;
    std::string camera, dataSet;
    const std::array<std::pair<const char*, std::string*>, 5> parts = {{
        {settingsKeyword, &note.settings},
        {cameraKeyword, &camera},
        {dataSetKeyword, &dataSet},
        {shotLineKeyword, &note.shotLine},
        {versionKeyword, &note.version},
    }};
    for (const auto& [keyword, text] : parts) {
        const Result<std::string> read = readPictureText(file, keyword);
        if (!read) return tl::unexpected(read.error());
        *text = *read;
    }
    if (note.settings.empty() || camera.empty()) {
        return planet::badInput(
            fmt::format("{}: contains no settings; expected an unmodified Worldy screenshot", file.string()));
    }
    const Result<planet::CameraPose> pose = poseFromText(camera);
    if (!pose) {
        return planet::badInput(fmt::format(
            "{}: invalid camera metadata: {}; expected LAT,LON,ALT,HEADING,PITCH", file.string(), camera));
    }
    note.camera = *pose;
    note.dataSet = dataSet;
    return note;
}

Result<fs::path> newScreenshotFile(const fs::path& folder, const std::tm& localTime) {
    return newTimedFile(folder, localTime, "", "png");
}

bool isPng(const fs::path& file) {
    constexpr std::array<char, 8> signature = {'\x89', 'P', 'N', 'G', '\r', '\n', '\x1a', '\n'};
    std::error_code status;
    if (!fs::is_regular_file(file, status)) return false;
    std::array<char, 8> start{};
    std::ifstream(file, std::ios::binary).read(start.data(), start.size());
    return start == signature;
}

Result<Settings> loadSettingsOfAnyKind(const fs::path& file) {
    if (!isPng(file)) return loadSettings(file);
    const Result<ScreenshotNote> note = readScreenshotNote(file);
    if (!note) return tl::unexpected(note.error());
    Result<Settings> settings = settingsFromText(note->settings, file);
    if (!settings) return settings;
    settings->camera = note->camera;
    return settings;
}

}  // namespace worldy
