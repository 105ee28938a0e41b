#include "app/settings/shot_line.h"

#include <fmt/format.h>

#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>

#include "app/settings/region_file.h"
#include "app/settings/settings_text.h"

namespace worldy {

std::string shellWord(std::string_view text) {
    constexpr std::string_view plain =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./,:@%";
    if (!text.empty() && text.find_first_not_of(plain) == std::string_view::npos) return std::string(text);
    std::string quoted = "'";
    for (const char letter : text) quoted += letter == '\'' ? std::string("'\\''") : std::string(1, letter);
    return quoted + "'";
}

bool showsSource(const OverlaySettings& overlay) {
    return overlay.colourBy == ColourBy::Source || overlay.sources;
}

std::string pathWord(const std::filesystem::path& path) {
    const std::string text = path.string();
    return shellWord(text.starts_with('-') ? "./" + text : text);
}

std::string absoluteWord(const std::filesystem::path& path) {
    std::error_code status;
    const std::filesystem::path whole = std::filesystem::absolute(path, status);
    return pathWord(status ? path : whole.lexically_normal());
}

std::string shotLine(const std::filesystem::path& chunkFile, const planet::CameraPose& pose,
                     const PictureSize& size, const ViewSettings& view,
                     const std::filesystem::path& colourImage, const std::filesystem::path& source) {
    std::string line = fmt::format("worldy shot {} -o shot.png --camera={} --size {}x{}", pathWord(chunkFile),
                                   cameraText(pose), size.widthPx, size.heightPx);
    if (!colourImage.empty()) line += " --colour-image " + pathWord(colourImage);
    if (!source.empty() && showsSource(view.overlay)) line += " --source " + pathWord(source);
    const std::filesystem::path regions = view.regions.file;
    if (!regions.empty() && regions != regionsFileOf(chunkFile)) line += " --regions " + pathWord(regions);
    for (const std::string& assignment : assignmentsFor(view)) line += " --set " + shellWord(assignment);
    return line;
}

}  // namespace worldy
