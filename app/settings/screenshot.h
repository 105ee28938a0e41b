// Pictures that know how they came about: the settings, the camera and the data set that a picture was taken
// with are kept in its PNG file as text, so that opening it brings them back.
#pragma once

#include <ctime>
#include <filesystem>
#include <string>

#include "app/base/picture.h"
#include "app/settings/settings.h"
#include "planet/base/result.h"
#include "planet/sphere/view.h"

namespace worldy {

// Each is kept as a tEXt chunk; ImageDescription holds the shot line too, where image viewers show it.
struct ScreenshotNote {
    std::string settings;       // settingsText, or viewSettingsText
    planet::CameraPose camera;  // as the picture sees it
    std::filesystem::path dataSet;
    std::string shotLine;
    std::string version;  // of Worldy; empty: this one
};

// Over what is there: a name that newScreenshotFile made.
planet::Result<void> writeScreenshot(const Picture& picture, const std::filesystem::path& file,
                                     const ScreenshotNote& note);

// Into a new file of picturesFolder(), named after now; returns which.
planet::Result<std::filesystem::path> writeNewScreenshot(const Picture& picture, const ScreenshotNote& note);

// The Error says where a picture is none that Worldy took.
planet::Result<ScreenshotNote> readScreenshotNote(const std::filesystem::path& file);

// "worldy 2026-11-21 14.03.22.png" in the folder, with " 2" and so on where there are such files: an empty
// file, made now, so that no two programs write the same one.
planet::Result<std::filesystem::path> newScreenshotFile(const std::filesystem::path& folder,
                                                        const std::tm& localTime);

// Whether a file begins as a PNG does.
bool isPng(const std::filesystem::path& file);

// A settings file, a preset, or a screenshot with its settings and camera.
planet::Result<Settings> loadSettingsOfAnyKind(const std::filesystem::path& file);

}  // namespace worldy
