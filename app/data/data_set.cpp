#include "app/data/data_set.h"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <array>
#include <functional>
#include <string_view>
#include <utility>
#include <vector>

#include "app/base/places.h"
#include "app/data/own_colour.h"
#include "app/data/worlds.h"
#include "planet/format/chunk_file.h"
#include "planet/source/colour_source.h"
#include "planet/source/height_source.h"
#include "planet/source/terrain.h"

namespace worldy {

namespace {

namespace fs = std::filesystem;

// Truncates a name to 80 bytes, because a file name has at most 255. Does not split a UTF-8 character.
std::string shortened(const std::string& name) {
    std::size_t length = std::min<std::size_t>(name.size(), 80);
    while (length > 0 && length < name.size() && (static_cast<unsigned char>(name[length]) & 0xC0u) == 0x80u)
        --length;
    return name.substr(0, length);
}

// The sources that bakes of the built-in Earth name.
constexpr std::array<std::string_view, 2> ourEarths = {"elevation.tif, 4320 x 2160 int16, equirectangular",
                                                       "earth.toml, 3 layers"};

// Returns colourImage if its name is that of the image that the colours were baked from. A chunk file does
// not store the folder of the image.
fs::path bakedColourOf(const fs::path& chunkFile, const fs::path& colourImage) {
    if (colourImage.empty()) return {};
    const planet::Result<planet::ChunkFile> file = planet::ChunkFile::open(chunkFile);
    if (!file || !file->info().colour) return {};
    const bool isIt = file->info().colour->source.starts_with(colourImage.filename().string() + ",");
    return isIt ? colourImage : fs::path();
}

// Returns an empty identity for default settings, so that their bakes keep their names. The memory limit of
// the source does not change a bake.
std::string identityOf(const planet::HeightSourceSettings& settings) {
    const auto text = [](const planet::HeightSourceSettings& s) {
        return fmt::format(" s{} {} {} {} {} {} {} {} {}", s.metresPerUnit.value_or(1), s.offsetM.value_or(0),
                           s.noDataValue.has_value(), s.noDataValue.value_or(0), s.fillM,
                           s.rawSize.value_or(0), s.rawBits.value_or(0), s.rawSigned, s.rawBigEndian);
    };
    std::string identity = text(settings);
    if (identity == text({})) identity.clear();
    // An explicit 1 or 0 overrides the tags of the file, and the text above does not tell it from an unset
    // one.
    if (settings.metresPerUnit == 1) identity += " unit 1";
    if (settings.offsetM == 0) identity += " offset 0";
    if (settings.skipBroken) identity += " skip broken";
    return identity;
}

// Returns the path, size and modification time of each file.
std::string identityOf(const std::vector<fs::path>& files) {
    std::string identity;
    for (const fs::path& file : files) {
        std::error_code status;
        identity += fmt::format("|{}|{}|{}", fs::absolute(file, status).lexically_normal().string(),
                                fs::file_size(file, status),
                                fs::last_write_time(file, status).time_since_epoch().count());
    }
    return identity;
}

// Returns an empty identity without colours, so that bakes without colours keep their names.
std::string identityOf(const fs::path& colour, const planet::ColourBakeSettings& settings) {
    if (colour.empty()) return {};
    return fmt::format(" colours {} {}{}", static_cast<int>(settings.format), settings.faceSize.value_or(0),
                       identityOf(planet::heightSourceFiles(colour).files));
}

// Returns true if the file and its root chunks are readable, so that a planet can open it.
bool opensWhole(const fs::path& chunkFile) {
    const planet::Result<planet::ChunkFile> file = planet::ChunkFile::open(chunkFile);
    return file && std::all_of(planet::allFaces.begin(), planet::allFaces.end(),
                               [&](planet::Face face) { return file->readRoot(face).has_value(); });
}

}  // namespace

fs::path colourImageOf(const fs::path& chunkFile) {
    const fs::path beside = colourImageBeside(chunkFile);
    if (!beside.empty()) return beside;
    const planet::Result<planet::ChunkFile> file = planet::ChunkFile::open(chunkFile);
    if (!file) return {};
    if (std::ranges::find(ourEarths, file->info().source) != ourEarths.end())
        return colourImageBeside(earthElevation());
    const fs::path source = sourceOf(file->info());
    return source.empty() ? fs::path() : ownColourImage(source);
}

fs::path sourceOf(const planet::ChunkFileInfo& info) {
    const bool made = planet::isTerrainText(info.source) && planet::heightSourceExists(info.source);
    return made ? fs::path(info.source) : fs::path();
}

fs::path cachedBakeOf(const fs::path& source, const planet::BakeSettings& settings,
                      const planet::HeightSourceSettings& sourceSettings, const fs::path& colour) {
    std::string identity =
        fmt::format("{} {} {} {} {}", planet::chunkFileVersion, settings.faceSize.value_or(0),
                    settings.chunkSize, settings.radiusM, settings.quantumM.value_or(0));
    if (settings.finestQuantumM) identity += fmt::format(" f{}", *settings.finestQuantumM);
    if (settings.compressionLevel != planet::defaultCompressionLevel)
        identity += fmt::format(" c{}", settings.compressionLevel);
    identity += identityOf(sourceSettings);
    const planet::HeightSourceFiles sourceFiles = planet::heightSourceFiles(source);
    identity += identityOf(sourceFiles.files);
    identity += " placed, scaled";  // excludes older bakes, which ignored the tags and sidecars of images
    if (planet::isTerrainText(source))
        identity += fmt::format("|{}", planet::wholeTerrainText(source).value_or(source.string()));
    identity += identityOf(colour, settings.colour);
    return cacheFolder() / fmt::format("{}-{:016x}.chk", shortened(sourceFiles.stem),
                                       XXH3_64bits(identity.data(), identity.size()));
}

fs::path earlierBakeOf(const fs::path& source, const planet::BakeSettings& settings) {
    constexpr std::size_t mostOpened = 32;
    const std::string stem = shortened(planet::heightSourceFiles(source).stem) + "-";
    constexpr std::size_t rest = 16 + std::string_view(".chk").size();  // after the stem
    std::vector<std::pair<fs::file_time_type, fs::path>> found;
    std::error_code status;
    for (fs::directory_iterator entry(cacheFolder(), status), end; !status && entry != end;
         entry.increment(status)) {
        const std::string name = entry->path().filename().string();
        std::error_code unknown;
        if (name.size() == stem.size() + rest && name.starts_with(stem) && name.ends_with(".chk"))
            found.emplace_back(entry->last_write_time(unknown), entry->path());
    }
    std::ranges::sort(found, std::greater());
    if (found.size() > mostOpened) found.resize(mostOpened);
    const auto fits = [&](const auto& each) {
        const planet::Result<planet::ChunkFile> file = planet::ChunkFile::open(each.second);
        // Nothing is gained by copying a first look.
        return file && file->info().hasSourceRecord &&
               planet::faceCells(file->info().shape) + 1 != firstLookFaceSize &&
               planet::chunkSize(file->info().shape) == settings.chunkSize &&
               file->info().shape.radiusM == settings.radiusM;
    };
    const auto newest = std::ranges::find_if(found, fits);
    return newest == found.end() ? fs::path() : newest->second;
}

DataSet firstLookOf(const DataSet& whole) {
    DataSet look = whole;
    look.settings.faceSize = firstLookFaceSize;
    look.settings.colour.faceSize = firstLookFaceSize;
    look.settings.debugLevelsFolder.clear();
    look.settings.reuse.clear();
    look.chunkFile = cachedBakeOf(look.source, look.settings, look.sourceSettings, look.bakedColour);
    look.needsBake = !opensWhole(look.chunkFile);
    return look;
}

planet::Result<DataSet> findDataSet(const fs::path& named, const planet::BakeSettings& settings,
                                    const planet::HeightSourceSettings& sourceSettings,
                                    const std::optional<fs::path>& colour) {
    const planet::Result<NamedSource> source = sourceNamed(named, settings);
    if (!source) return tl::unexpected(source.error());
    if (planet::isTerrainText(source->source)) {
        if (const auto good = planet::terrainFromText(source->source); !good)
            return tl::unexpected(good.error());
    } else if (planet::heightSourceFiles(source->source).files.empty()) {
        return planet::badInput(
            fmt::format("{}: no such file; expected a chunk file (.chk), an elevation image or raster, a "
                        "world file, one of six cube "
                        "faces, terrain such as noise:ridged, or a preset such as preset:moon",
                        named.string()));
    } else if (named.extension() == ".chk") {
        DataSet set{.source = named, .chunkFile = named, .colourImage = colourImageOf(named)};
        set.bakedColour = bakedColourOf(named, colour.value_or(set.colourImage));
        return set;
    }
    DataSet set{.source = source->source,
                .chunkFile = {},
                .colourImage = ownColourImage(source->source),
                .settings = source->settings,
                .sourceSettings = sourceSettings};
    // The layers of colour of a world file are baked, and the image beside it is only laid over the planet.
    const bool hasLayers = planet::hasColourLayers(set.source);
    set.bakedColour = colour.value_or(hasLayers ? set.source : set.colourImage);
    set.chunkFile = cachedBakeOf(set.source, set.settings, sourceSettings, set.bakedColour);
    set.needsBake = !opensWhole(set.chunkFile);
    return set;
}

}  // namespace worldy
