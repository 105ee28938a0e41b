// Finds the files of a cube's six faces by their names.

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <iterator>
#include <map>
#include <string_view>
#include <system_error>

#include "planet/source/geo_tags.h"
#include "planet/source/height_source.h"
#include "planet/source/height_source_kinds.h"
#include "planet/source/terrain.h"

namespace planet {

namespace {

constexpr std::size_t mostSizeDigits = 7;

std::string faceFileName(const std::string& stem, Face face, const std::string& extension) {
    return fmt::format("{}_{}{}", stem, faceName(face), extension);
}

// Returns "earth4097" for "earth4097_z_pos"; nothing if the name has no face.
std::optional<std::string> withoutFace(const std::string& name) {
    for (const Face face : allFaces) {
        const std::string ending = fmt::format("_{}", faceName(face));
        if (name.size() > ending.size() && name.ends_with(ending)) {
            return name.substr(0, name.size() - ending.size());
        }
    }
    return std::nullopt;
}

std::optional<int> trailingNumber(const std::string& name) {
    std::size_t begin = name.size();
    while (begin > 0 && std::isdigit(static_cast<unsigned char>(name[begin - 1])) != 0) --begin;
    const std::size_t digits = name.size() - begin;
    if (digits == 0 || digits > mostSizeDigits) return std::nullopt;
    int number = 0;
    std::from_chars(name.data() + begin, name.data() + name.size(), number);
    return number;
}

std::string lowerCase(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

// Returns whether OpenImageIO reads a format of this extension. Its list is "png:png;tiff:tif,tiff,env;...".
bool isHeightExtension(const std::string& extension) {
    if (extension.size() < 2) return false;
    const std::string wanted = lowerCase(extension.substr(1));
    if (wanted == "raw") return true;
    static const std::string known = OIIO::get_string_attribute("extension_list");
    for (std::size_t at = known.find(wanted); at != std::string::npos; at = known.find(wanted, at + 1)) {
        const std::size_t end = at + wanted.size();
        const bool starts = at > 0 && (known[at - 1] == ':' || known[at - 1] == ',');
        const bool ends = end == known.size() || known[end] == ',' || known[end] == ';';
        if (starts && ends) return true;
    }
    return false;
}

// Returns the extension of most faces: .raw first, then in alphabetical order. Empty if there is none.
std::string extensionOfFaces(const std::filesystem::path& folder, const std::string& stem) {
    std::map<std::string, int> facesWith;
    std::error_code problem;
    for (std::filesystem::directory_iterator entry(folder.empty() ? "." : folder, problem), end;
         !problem && entry != end; entry.increment(problem)) {
        const std::filesystem::path& path = entry->path();
        if (withoutFace(path.stem().string()) != stem) continue;
        const std::string extension = path.extension().string();
        if (isHeightExtension(extension)) ++facesWith[extension];
    }
    std::string best;
    int most = 0;
    for (const auto& [extension, faces] : facesWith) {
        if (faces > most || (faces == most && lowerCase(extension) == ".raw")) {
            best = extension;
            most = faces;
        }
    }
    return best;
}

}  // namespace

std::optional<FaceFiles> findFaceFiles(const std::filesystem::path& path) {
    const std::filesystem::path folder = path.parent_path();
    FaceFiles files;
    const std::optional<std::string> named = withoutFace(path.stem().string());
    std::error_code problem;
    if (named && path.has_extension()) {
        files.stem = *named;
        files.extension = path.extension().string();
    } else {
        if (std::filesystem::exists(path, problem)) return std::nullopt;
        files.stem = named ? *named : path.filename().string();
        files.extension = extensionOfFaces(folder, files.stem);
        if (files.extension.empty()) return std::nullopt;
    }
    files.sizeInName = trailingNumber(files.stem);
    for (const Face face : allFaces) {
        files.paths[static_cast<std::size_t>(face)] =
            folder / faceFileName(files.stem, face, files.extension);
    }
    return files;
}

namespace {

// Returns the files of a terrain text. The stem of "noise:ridged,seed=7" is ridged, that of
// "detail:of=elevation.tif" is elevation-detail. An invalid text has no files.
HeightSourceFiles terrainFiles(const std::filesystem::path& text) {
    const Result<TerrainSource> terrain = terrainFromText(text);
    if (!terrain) return {"terrain", {}};
    if (!terrain->of.empty()) {
        HeightSourceFiles files = heightSourceFiles(terrain->of);
        files.stem += "-detail";
        return files;
    }
    const std::string_view kind = kindOf(terrain->settings).name;
    return {std::string(kind.substr(kind.find(':') + 1)), {}};
}

bool terrainExists(const std::filesystem::path& text) {
    const Result<TerrainSource> terrain = terrainFromText(text);
    return terrain && (terrain->of.empty() || heightSourceExists(terrain->of));
}

void addSidecars(std::vector<std::filesystem::path>& files) {
    std::vector<std::filesystem::path> sidecars;
    for (const std::filesystem::path& file : files) {
        const std::vector<std::filesystem::path> found = sidecarsOf(file);
        sidecars.insert(sidecars.end(), found.begin(), found.end());
    }
    files.insert(files.end(), sidecars.begin(), sidecars.end());
}

}  // namespace

HeightSourceFiles heightSourceFiles(const std::filesystem::path& path) {
    if (isTerrainText(path)) return terrainFiles(path);
    std::error_code problem;
    HeightSourceFiles found;
    const std::optional<FaceFiles> faces = findFaceFiles(path);
    found.stem = faces ? faces->stem : path.stem().string();
    if (!faces) {
        if (std::filesystem::is_regular_file(path, problem)) found.files.push_back(path);
        addSidecars(found.files);
        return found;
    }
    std::copy_if(faces->paths.begin(), faces->paths.end(), std::back_inserter(found.files),
                 [&](const auto& file) { return std::filesystem::is_regular_file(file, problem); });
    addSidecars(found.files);
    return found;
}

bool heightSourceExists(const std::filesystem::path& path) {
    if (isTerrainText(path)) return terrainExists(path);
    return !path.empty() && path.extension() != ".chk" && !heightSourceFiles(path).files.empty();
}

}  // namespace planet
