// Finds the files of a source: those of a cube's six faces by their names, and those that match a pattern.

#include <fmt/format.h>
#include <glob.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>
#include <string_view>
#include <system_error>

#include "planet/raster/image_formats.h"
#include "planet/raster/image_names.h"
#include "planet/raster/vrt_file.h"
#include "planet/source/height_source.h"
#include "planet/source/height_source_kinds.h"
#include "planet/source/terrain.h"
#include "planet/source/toml_file.h"
#include "planet/source/world_file.h"

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

bool isHeightExtension(const std::string& extension) {
    return lowerCase(extension) == ".raw" || isImageExtension(extension);
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

bool isFilePattern(const std::filesystem::path& path) {
    std::error_code problem;
    return path.string().find_first_of("*?[|") != std::string::npos &&
           !std::filesystem::exists(path, problem);
}

namespace {

std::vector<std::filesystem::path> filesMatching(const std::string& pattern) {
    glob_t found{};
    std::vector<std::filesystem::path> files;
    if (::glob(pattern.c_str(), GLOB_NOSORT, nullptr, &found) == 0)
        files.assign(found.gl_pathv, found.gl_pathv + found.gl_pathc);
    ::globfree(&found);
    std::error_code problem;
    std::erase_if(files, [&](const auto& file) { return !std::filesystem::is_regular_file(file, problem); });
    std::ranges::sort(files);
    return files;
}

}  // namespace

std::vector<std::filesystem::path> filesOfPattern(const std::filesystem::path& pattern) {
    std::vector<std::filesystem::path> files;
    std::istringstream parts(pattern.string());
    for (std::string part; std::getline(parts, part, '|');) {
        std::error_code problem;
        // The name of a file may have the letters of a pattern.
        const bool isFile = std::filesystem::is_regular_file(part, problem);
        const auto found = isFile ? std::vector<std::filesystem::path>{part} : filesMatching(part);
        files.insert(files.end(), found.begin(), found.end());
    }
    return files;
}

bool isWorldFile(const std::filesystem::path& path) {
    if (path.extension() != ".toml") return false;
    std::error_code problem;
    if (!std::filesystem::is_regular_file(path, problem)) return false;
    if (std::filesystem::file_size(path, problem) > mostTomlBytes) return false;
    std::ifstream stream(path);
    for (std::string line; std::getline(stream, line);) {
        const std::size_t first = line.find_first_not_of(" \t");
        if (first == std::string::npos) continue;
        const std::string_view text = std::string_view(line).substr(first);
        if (text.starts_with("[[elevation]]") || text.starts_with("[[colour]]")) return true;
    }
    return false;
}

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

// Returns a name for the files of a pattern: its letters and digits, or else its folder. "tiles/N*W123.hgt" gives
// NW123, and "tiles/*.tif" gives tiles.
std::string stemOfPattern(const std::filesystem::path& pattern) {
    // A list is named after its first part.
    if (const std::string text = pattern.string(); text.find('|') != text.npos) {
        const std::filesystem::path first = text.substr(0, text.find('|'));
        return isFilePattern(first) ? stemOfPattern(first) : first.stem().string();
    }
    std::string stem = pattern.stem().string();
    std::erase_if(
        stem, [](char letter) { return std::string_view("*?[]!").find(letter) != std::string_view::npos; });
    if (!stem.empty()) return stem;
    stem = pattern.parent_path().filename().string();
    return stem.empty() || isFilePattern(stem) || stem.starts_with('.') ? "rasters" : stem;
}

bool terrainExists(const std::filesystem::path& text) {
    const Result<TerrainSource> terrain = terrainFromText(text);
    return terrain && (terrain->of.empty() || heightSourceExists(terrain->of));
}

// Adds what lies beside files and is read with them, and the sources of a VRT.
void addSidecars(std::vector<std::filesystem::path>& files) {
    std::vector<std::filesystem::path> sidecars;
    for (const std::filesystem::path& file : files) {
        if (lowerCase(file.extension().string()) != ".vrt") continue;
        const Result<VrtFile> vrt = checkedVrt(file);
        if (vrt) sidecars.insert(sidecars.end(), vrt->sources.begin(), vrt->sources.end());
    }
    for (const std::filesystem::path& file : files) {
        const std::vector<std::filesystem::path> found = sidecarsOf(file);
        sidecars.insert(sidecars.end(), found.begin(), found.end());
        // The reference system of a raster, and the header of one without a header of its own.
        for (const char* const extension : {".prj", ".hdr"}) {
            std::filesystem::path beside = file;
            beside.replace_extension(extension);
            std::error_code problem;
            if (beside != file && std::filesystem::is_regular_file(beside, problem))
                sidecars.push_back(beside);
        }
    }
    files.insert(files.end(), sidecars.begin(), sidecars.end());
}

}  // namespace

namespace {

// Returns the world file and those of its layers, as far as it can be read.
HeightSourceFiles worldFiles(const std::filesystem::path& path) {
    HeightSourceFiles found{path.stem().string(), {path}};
    const Result<WorldFile> world = readWorldFile(path);
    if (!world) return found;
    for (const auto* layers : {&world->layers, &world->colours}) {
        for (const WorldLayer& layer : *layers) {
            for (const std::filesystem::path& named : layer.files) {
                if (isWorldFile(named)) continue;
                const HeightSourceFiles files = heightSourceFiles(named);
                found.files.insert(found.files.end(), files.files.begin(), files.files.end());
            }
        }
    }
    return found;
}

}  // namespace

HeightSourceFiles heightSourceFiles(const std::filesystem::path& path) {
    if (isTerrainText(path)) return terrainFiles(path);
    if (isWorldFile(path)) return worldFiles(path);
    std::error_code problem;
    HeightSourceFiles found;
    if (isFilePattern(path)) {
        found = {stemOfPattern(path), filesOfPattern(path)};
        addSidecars(found.files);
        return found;
    }
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
    // A panel asks this in every frame, so neither a world file nor what lies beside the files of a pattern is read.
    if (isTerrainText(path)) return terrainExists(path);
    if (isWorldFile(path)) return true;
    if (isFilePattern(path)) return !filesOfPattern(path).empty();
    return !path.empty() && path.extension() != ".chk" && !heightSourceFiles(path).files.empty();
}

}  // namespace planet
