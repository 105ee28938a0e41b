// Screenshots that can be reproduced: a PNG file stores the settings, the camera and the data set as text,
// and opening it restores them.
#pragma once

#include <ctime>
#include <filesystem>
#include <string>

#include "app/base/picture.h"
#include "app/settings/settings.h"
#include "planet/base/result.h"
#include "planet/sphere/view.h"

namespace worldy {

// The texts stored in a screenshot, each in a tEXt chunk. ImageDescription also contains the shot line,
// because image viewers show it.
struct ScreenshotNote {
    std::string settings;       // settingsText() or viewSettingsText()
    planet::CameraPose camera;  // the camera of the picture
    std::filesystem::path dataSet;
    std::string shotLine;
    std::string version;  // Worldy's version; empty: this one
};

// Writes a screenshot over an existing file, which newScreenshotFile() has created.
planet::Result<void> writeScreenshot(const Picture& picture, const std::filesystem::path& file,
                                     const ScreenshotNote& note);

// Writes a screenshot into a new file in picturesFolder(), named after the current time. Returns the file.
planet::Result<std::filesystem::path> writeNewScreenshot(const Picture& picture, const ScreenshotNote& note);

// Reads the texts. The Error says if the picture is not a screenshot of Worldy.
planet::Result<ScreenshotNote> readScreenshotNote(const std::filesystem::path& file);

// Creates an empty file "worldy 2026-11-21 14.03.22.png" in the folder, with " 2" and so on if that exists.
// It is created now, so that no two programs write the same one.
planet::Result<std::filesystem::path> newScreenshotFile(const std::filesystem::path& folder,
                                                        const std::tm& localTime);

// Returns true if a file begins like a PNG.
bool isPng(const std::filesystem::path& file);

// Loads a settings file, a preset, or a screenshot with its settings and camera.
planet::Result<Settings> loadSettingsOfAnyKind(const std::filesystem::path& file);

}  // namespace worldy
