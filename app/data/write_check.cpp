#include "app/data/write_check.h"

#include <fmt/format.h>

#include <cstring>
#include <string>
#include <string_view>

#include "app/base/output_file.h"
#include "app/base/picture_file.h"
#include "app/data/data_set.h"
#include "app/data/own_colour.h"
#include "app/data/worlds.h"
#include "app/settings/layer_file.h"
#include "app/settings/region_file.h"
#include "app/settings/screenshot.h"
#include "app/settings/settings_text.h"
#include "planet/base/atomic_file.h"
#include "planet/format/chunk_file_format.h"
#include "planet/source/height_source.h"

namespace worldy {

namespace {

namespace fs = std::filesystem;
using planet::Result;

// Returns all files below a folder, or the path itself if it is not a folder.
std::vector<fs::path> filesIn(const fs::path& path) {
    std::error_code status;
    if (!fs::is_directory(path, status)) return {path};
    std::vector<fs::path> files;
    for (fs::recursive_directory_iterator entry(path, status), end; !status && entry != end;
         entry.increment(status))
        files.push_back(entry->path());
    return files;
}

constexpr std::size_t lookedAtBytes = 4096;

// Returns true for a chunk file of any version.
bool isChunkFile(const fs::path& file) {
    constexpr std::size_t magicBytes = 8;
    const auto header = planet::headerBytes({}, 0);
    const std::string start = startOfFile(file, magicBytes);
    return start.size() == magicBytes && std::memcmp(start.data(), header.data(), magicBytes) == 0;
}

// Every report begins with its schema_version (report.h).
bool isJson(const fs::path& file) {
    std::string start = startOfFile(file, lookedAtBytes);
    std::erase_if(start, [](char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; });
    return start.starts_with("{\"schema_version\":");
}

bool isCsv(const fs::path& file) {
    return startOfFile(file, lookedAtBytes).starts_with("schema_version,");
}

bool isOfKind(const fs::path& file, OutputKind kind) {
    switch (kind) {
        case OutputKind::ChunkFile:
            return isChunkFile(file);
        case OutputKind::Json:
            return isJson(file);
        case OutputKind::Csv:
            return isCsv(file);
        case OutputKind::Picture:
            return isOwnPicture(file);
        case OutputKind::PngImage:
            return isPng(file);
        case OutputKind::LayerSet:
            return loadLayerSet(file).has_value();
        case OutputKind::Preset:
            return loadViewPart(file).has_value();
        case OutputKind::Layout:
            return loadLayout(file).has_value();
        case OutputKind::ItemMap:
            return startOfFile(file, 8) == "counter/";
        case OutputKind::Trace:
            return startOfFile(file, 8) == "LODTRACE";
        case OutputKind::Atlas:
            return startOfFile(file, 8) == "WORLDYAT";
        case OutputKind::Regions:
            return loadRegions(file).has_value();
        case OutputKind::SuggestReport:
            return startOfFile(file, lookedAtBytes).starts_with("# Suggested settings for ");
    }
    return false;
}

std::string_view nameOf(OutputKind kind) {
    switch (kind) {
        case OutputKind::ChunkFile:
            return "a chunk file";
        case OutputKind::Json:
            return "a JSON report of Worldy";
        case OutputKind::Csv:
            return "a CSV table of Worldy";
        case OutputKind::Picture:
            return "an 8-bit RGB picture in the format of its extension, without GeoTIFF tags";
        case OutputKind::PngImage:
            return "a PNG image";
        case OutputKind::LayerSet:
            return "a layer set";
        case OutputKind::Preset:
            return "a preset";
        case OutputKind::Layout:
            return "a layout";
        case OutputKind::ItemMap:
            return "an item map";
        case OutputKind::Trace:
            return "a trace";
        case OutputKind::Atlas:
            return "an atlas";
        case OutputKind::Regions:
            return "a regions file";
        case OutputKind::SuggestReport:
            return "a report of worldy suggest";
    }
    return "";
}

Result<void> checkApart(const fs::path& output, const fs::path& input) {
    std::error_code status;
    for (const fs::path& file : filesIn(input)) {
        if (!fs::equivalent(file, output, status)) continue;
        if (file == output) {
            return planet::badInput(fmt::format(
                "{}: is an input of this command and cannot be its output; expected another output file",
                output.string()));
        }
        return planet::badInput(fmt::format(
            "{}: is the same file as {}, which is an input of this command; expected another output file",
            output.string(), file.string()));
    }
    return {};
}

// Checks that a folder can be created. A dangling link of that name prevents it.
Result<void> checkFolderCanBeMade(const fs::path& folder) {
    std::error_code status;
    fs::path there = fs::absolute(folder, status);
    while (!fs::exists(fs::symlink_status(there, status)) && there.has_relative_path())
        there = there.parent_path();
    if (fs::is_directory(there, status)) return planet::checkWritable(there / "file");
    return planet::badInput(fmt::format(
        "{}: {} {}; expected a folder or an unused name", folder.string(), there.string(),
        fs::exists(there, status) ? "is not a folder" : "is a link to a folder that does not exist"));
}

// Returns the path with all links resolved, even if the file does not exist.
fs::path canonicalOf(const fs::path& path) {
    std::error_code status;
    const fs::path absolute = fs::absolute(path, status);
    const fs::path canonical = fs::weakly_canonical(planet::linkTarget(absolute).value_or(absolute), status);
    return status ? path : canonical;
}

}  // namespace

void addSource(CommandFiles& files, const fs::path& source) {
    if (source.empty()) return;
    if (source.extension() == ".chk") return addChunkFile(files, source);
    const Result<NamedSource> named = sourceNamed(source, {});
    const fs::path path = named ? named->source : source;
    for (const fs::path& file : planet::heightSourceFiles(path).files) files.inputs.push_back(file);
    files.inputs.push_back(ownColourImage(path));
}

void addChunkFile(CommandFiles& files, const fs::path& chunkFile) {
    if (chunkFile.empty()) return;
    files.inputs.push_back(chunkFile);
    files.inputs.push_back(colourImageOf(chunkFile));
}

Result<void> checkNotInputs(const CommandFiles& files) {
    for (auto output = files.outputs.begin(); output != files.outputs.end(); ++output) {
        if (output->path.empty()) continue;
        for (auto other = files.outputs.begin(); other != output; ++other) {
            if (canonicalOf(other->path) != canonicalOf(output->path) || other->path.empty()) continue;
            return planet::badInput(fmt::format("{}: is the name of two outputs; expected a file for each",
                                                output->path.string()));
        }
        std::error_code status;
        if (!fs::exists(output->path, status)) continue;
        for (const fs::path& input : files.inputs) {
            if (Result<void> apart = checkApart(output->path, input); !apart) return apart;
        }
    }
    return {};
}

Result<void> checkKinds(const std::vector<OutputFile>& outputs) {
    for (const OutputFile& output : outputs) {
        std::error_code status;
        if (output.path.empty() || !fs::is_regular_file(output.path, status)) continue;
        if (fs::file_size(output.path, status) == 0 || isOfKind(output.path, output.kind)) continue;
        return planet::badInput(fmt::format("{}: exists and is not {}; expected another name",
                                            output.path.string(), nameOf(output.kind)));
    }
    return {};
}

Result<void> checkPlaces(const std::vector<OutputFile>& outputs) {
    for (const OutputFile& output : outputs) {
        if (output.path.empty()) continue;
        const fs::path folder = output.path.parent_path();
        std::error_code status;
        const bool willBeMade = output.makesFolder && !fs::is_directory(folder, status);
        const Result<void> writable =
            willBeMade ? checkFolderCanBeMade(folder) : planet::checkWritable(output.path);
        if (!writable) return writable;
        // The usual extensions are known without the image libraries, which take long to load.
        const std::string extension = output.path.extension().string();
        const bool isUsual = extension == ".png" || extension == ".jpg" || extension == ".tif";
        if (output.kind != OutputKind::Picture || isUsual) continue;
        if (Result<void> known = checkPictureName(output.path); !known) return known;
    }
    return {};
}

Result<void> checkOutputs(const CommandFiles& files, bool overwrite) {
    Result<void> good = checkNotInputs(files).and_then([&] { return checkPlaces(files.outputs); });
    if (!good || overwrite) return good;
    return checkKinds(files.outputs).map_error([](planet::Error error) {
        error.message += ", or --overwrite to replace it";
        return error;
    });
}

}  // namespace worldy
