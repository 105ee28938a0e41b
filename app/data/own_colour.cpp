#include "app/data/own_colour.h"

#include "planet/source/terrain.h"

namespace worldy {

namespace {

namespace fs = std::filesystem;

// Returns the file that detail is added to, or the source itself if it is a file; empty for terrain without a
// file.
fs::path fileUnder(const fs::path& source) {
    if (!planet::isTerrainText(source)) return source;
    const planet::Result<planet::TerrainSource> terrain = planet::terrainFromText(source);
    return terrain && !terrain->of.empty() ? fileUnder(terrain->of) : fs::path();
}

}  // namespace

fs::path colourImageBeside(const fs::path& file) {
    std::error_code status;
    for (const char* name : {"colour.jpg", "colour.png"}) {
        const fs::path image = file.parent_path() / name;
        if (fs::is_regular_file(image, status)) return image;
    }
    return {};
}

fs::path ownColourImage(const fs::path& source) {
    const fs::path file = fileUnder(source);
    return file.empty() ? fs::path() : colourImageBeside(file);
}

}  // namespace worldy
