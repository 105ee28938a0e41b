#include "app/cli/file_commands.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/base/interrupt.h"
#include "app/base/message.h"
#include "app/base/report.h"
#include "app/base/text.h"
#include "app/data/worlds.h"
#include "planet/bake/colour_report.h"
#include "planet/bake/file_report.h"
#include "planet/format/chunk_file.h"
#include "planet/source/source_layers.h"

namespace worldy {

namespace {

using Json = nlohmann::ordered_json;
using planet::ChunkFile;
using planet::Result;

using ColourLevels = std::vector<planet::ColourLevelReport>;

std::string_view formatName(planet::ColourFormat format) {
    return format == planet::ColourFormat::Bc1 ? "bc1" : "lossless";
}

Json colourJson(const planet::ColourPyramid& colour, const ColourLevels& levels) {
    Json json = {{"source", colour.source},
                 {"format", formatName(colour.format)},
                 {"face_size", (planet::colourTileCells << colour.leafLevel) + 1},
                 {"levels", Json::array()}};
    for (const planet::ColourLevelReport& level : levels)
        json["levels"].push_back({{"level", level.level}, {"tiles", level.tiles}, {"bytes", level.bytes}});
    return json;
}

void printColour(const planet::ColourPyramid& colour, const ColourLevels& levels) {
    const int size = (planet::colourTileCells << colour.leafLevel) + 1;
    fmt::print("\ncolours: {}, {}, faces of {} x {}\n", colour.source, formatName(colour.format), size, size);
    fmt::print("{:>5}{:>10}{:>12}\n", "level", "tiles", "size");
    for (const planet::ColourLevelReport& level : levels) {
        fmt::print("{:>5}{:>10}{:>12}\n", level.level, level.tiles,
                   bytesText(static_cast<double>(level.bytes)));
    }
}

Json infoJson(const ChunkFile& file, const planet::FileReport& report) {
    const planet::ChunkFileInfo& info = file.info();
    Json json = {{"file", file.name()},
                 {"source", info.source},
                 {"face_size", planet::faceCells(info.shape) + 1},
                 {"chunk_size", planet::chunkSize(info.shape)},
                 {"radius_m", info.shape.radiusM},
                 {"quantum_m", fileQuantumM(info.shape)},
                 {"finest_quantum_m", info.shape.quantumM},
                 {"fraction_bits", info.shape.fractionBits},
                 {"min_height_m", planet::heightM(info.shape, info.minStep)},
                 {"max_height_m", planet::heightM(info.shape, info.maxStep)},
                 {"missing_samples", info.missingSamples},
                 {"chunks", info.chunks},
                 {"leaves", planet::leafCountOf(info.chunks)},
                 {"coarsest_leaf_level", info.coarsestLeafLevel},
                 {"file_bytes", report.fileBytes},
                 {"finest_samples", report.finestSamples},
                 {"bits_per_sample", report.bitsPerFinestSample},
                 {"levels", Json::array()}};
    for (const planet::LevelReport& level : report.levels) {
        json["levels"].push_back({{"level", level.level},
                                  {"chunks", level.chunks},
                                  {"leaves", level.leaves},
                                  {"bytes", level.bytes},
                                  {"min_delta_m", level.minDeltaM},
                                  {"median_delta_m", level.medianDeltaM},
                                  {"p99_delta_m", level.p99DeltaM},
                                  {"max_delta_m", level.maxDeltaM},
                                  {"mean_delta_m", level.meanDeltaM},
                                  {"mean_tight_m", level.meanTightM},
                                  {"max_tight_m", level.maxTightM}});
    }
    return json;
}

void printInfo(const ChunkFile& file, const planet::FileReport& report) {
    const planet::ChunkFileInfo& info = file.info();
    const planet::PlanetShape& shape = info.shape;
    fmt::print("{}\n", file.name());
    fmt::print("  source           {}\n", info.source);
    fmt::print("  radius           {} m\n", shape.radiusM);
    const std::string fractions =
        shape.fractionBits == 0 ? ""
                                : fmt::format(", down to {} m where the source is finer", shape.quantumM);
    fmt::print("  heights          {} to {} m in steps of {} m{}\n", planet::heightM(shape, info.minStep),
               planet::heightM(shape, info.maxStep), fileQuantumM(shape), fractions);
    const double cellM = shape.radiusM * std::numbers::pi / 2 / planet::faceCells(shape);
    fmt::print("  faces            {0} x {0} samples, {1} apart on the deepest level\n",
               planet::faceCells(shape) + 1, fmt::format("{:.3g} m", cellM));
    fmt::print("  chunks           {0} x {0} vertices\n", planet::chunkSize(shape));
    fmt::print("  leaves           {} of {} chunks, on levels {} to {}\n", planet::leafCountOf(info.chunks),
               info.chunks, info.coarsestLeafLevel, planet::deepestLevelOf(shape));
    fmt::print("  finest samples   {}; source samples without data: {}\n", report.finestSamples,
               info.missingSamples);
    fmt::print("  size             {}, {:.2f} bits per finest sample\n\n",
               bytesText(static_cast<double>(report.fileBytes)), report.bitsPerFinestSample);
    fmt::print("{:>39}{:>14}{:>56}{:>14}\n", "", "delta_c, m:", "", "tight, m:");
    fmt::print("{:>5}{:>10}{:>10}{:>12}  {:>14}{:>14}{:>14}{:>14}{:>14}{:>14}{:>14}\n", "level", "chunks",
               "leaves", "size", "smallest", "median", "99th perc.", "largest", "mean", "mean", "largest");
    for (const planet::LevelReport& level : report.levels) {
        fmt::print(
            "{:>5}{:>10}{:>10}{:>12}  {:>14.3f}{:>14.3f}{:>14.3f}{:>14.3f}{:>14.3f}{:>14.3f}{:>14.3f}\n",
            level.level, level.chunks, level.leaves, bytesText(static_cast<double>(level.bytes)),
            level.minDeltaM, level.medianDeltaM, level.p99DeltaM, level.maxDeltaM, level.meanDeltaM,
            level.meanTightM, level.maxTightM);
    }
}

std::string problemsText(std::uint64_t count) {
    return fmt::format("{} {}", count, count == 1 ? "problem" : "problems");
}

double degreesOf(double slope) {
    return glm::degrees(std::atan(slope));
}

Json rimsJson(const std::optional<planet::RimReport>& rims) {
    if (!rims) return nullptr;
    const planet::SteepestStep& steepest = rims->steepest;
    return {{"leaves", rims->leaves},
            {"step_m", steepest.stepM},
            {"over_m", steepest.overM},
            {"slope_deg", degreesOf(steepest.slope())},
            {"chunk", planet::toString(steepest.chunk)},
            {"latitude_deg", glm::degrees(steepest.place.latitudeRad)},
            {"longitude_deg", glm::degrees(steepest.place.longitudeRad)},
            {"level_p999_slope_deg", degreesOf(rims->levelP999Slope)},
            {"level_largest_slope_deg", degreesOf(rims->levelLargestSlope)}};
}

void printRims(const FileCommandOptions& options, const planet::RimReport& rims) {
    const planet::SteepestStep& steepest = rims.steepest;
    fmt::print(
        "{}: the steepest step at a rim of finer data is {:.1f} m over {:.1f} m ({:.1f}°), at {} in chunk "
        "{}; on leaves "
        "of its level, 99.9 % of the slopes are below {:.1f}°, and the steepest has {:.1f}°\n",
        options.file.string(), steepest.stepM, steepest.overM, degreesOf(steepest.slope()),
        placeText(glm::degrees(steepest.place.latitudeRad), glm::degrees(steepest.place.longitudeRad)),
        planet::toString(steepest.chunk), degreesOf(rims.levelP999Slope), degreesOf(rims.levelLargestSlope));
}

void printVerified(const FileCommandOptions& options, const planet::VerifyReport& report,
                   const planet::ColourVerifyReport& colours) {
    std::vector<std::string> problems = report.problems;
    problems.insert(problems.end(), colours.problems.begin(), colours.problems.end());
    if (options.json) {
        const Json json = {{"file", options.file.string()},
                           {"chunks", report.chunks},
                           {"edges", report.edges},
                           {"leaf_samples", report.leafSamples},
                           {"rims", rimsJson(report.rims)},
                           {"colour_tiles", colours.tiles},
                           {"colour_edges", colours.edges},
                           {"colour_tiles_compared", colours.compared},
                           {"problem_count", report.problemCount + colours.problemCount},
                           {"problems", problems}};
        fmt::print("{}", jsonText(json));
        return;
    }
    for (const std::string& problem : problems) fmt::print("{}\n", problem);
    const std::string compared =
        options.source.empty() ? ""
                               : fmt::format("{} samples compared with the source, ", report.leafSamples);
    fmt::print("{}: {} chunks and {} shared edges checked, {}{}\n", options.file.string(), report.chunks,
               report.edges, compared, problemsText(report.problemCount));
    if (report.rims) printRims(options, *report.rims);
    if (colours.tiles > 0) {
        const std::string comparedTiles =
            options.colour.empty() ? "" : fmt::format("{} compared with the image, ", colours.compared);
        fmt::print("{}: {} colour tiles and {} shared edges checked, {}{}\n", options.file.string(),
                   colours.tiles, colours.edges, comparedTiles, problemsText(colours.problemCount));
    }
}

Result<planet::ColourVerifyReport> verifyColoursOf(const ChunkFile& file, const FileCommandOptions& options,
                                                   const InterruptWatch& watch) {
    if (!file.info().colour) {
        if (options.colour.empty()) return planet::ColourVerifyReport();
        return planet::badInput(fmt::format("{}: has no colours to compare with {}; bake it with --colour",
                                            options.file.string(), options.colour.string()));
    }
    std::optional<planet::ColourSource> source;
    if (!options.colour.empty()) {
        Result<planet::ColourSource> opened = planet::openColourSource(options.colour);
        if (!opened) return tl::unexpected(opened.error());
        source = *std::move(opened);
    }
    return planet::verifyColours(file, source ? &*source : nullptr, [&] { return !watch.interrupted(); });
}

// Opens the source of the options, which may be the name of a built-in world.
Result<planet::HeightSource> openNamed(const FileCommandOptions& options) {
    return sourceNamed(options.source, {}).and_then([&](const NamedSource& named) {
        return planet::openHeightSource(named.source, options.sourceSettings);
    });
}

// The readings of a source's layers at a place; nothing if no source was asked for.
struct SourceProbe {
    std::shared_ptr<const planet::SourceLayers> source;
    std::vector<planet::SourceReading> readings;
};

Result<std::optional<SourceProbe>> probeSource(const FileCommandOptions& options,
                                               const planet::Geographic& place) {
    if (options.source.empty()) return std::nullopt;
    const Result<planet::HeightSource> source = openNamed(options);
    if (!source) return tl::unexpected(source.error());
    Result<std::vector<planet::SourceReading>> readings = source->layers->at(place);
    if (!readings) return tl::unexpected(readings.error());
    return SourceProbe{source->layers, *std::move(readings)};
}

constexpr std::array<std::string_view, 5> layerKindNames = {"rasters", "image", "faces", "terrain", "detail"};

Json sourceJson(const FileCommandOptions& options, const SourceProbe& probe) {
    Json json = {
        {"source", options.source.string()}, {"fill_m", probe.source->fillM}, {"layers", Json::array()}};
    const std::vector<double> shares = planet::sharesOf(*probe.source, probe.readings);
    for (std::size_t i = 0; i < shares.size(); ++i) {
        const planet::SourceReading& reading = probe.readings[i];
        const planet::SourceLayer& layer = probe.source->layers[reading.layer];
        Json entry = {{"layer", layer.name},
                      {"kind", layerKindNames[static_cast<std::size_t>(layer.kind)]},
                      {"join", planet::nameOf(layer.join)},
                      {"height_m", reading.heightM ? Json(*reading.heightM) : Json(nullptr)},
                      {"share", reading.heightM ? Json(shares[i]) : Json(nullptr)},
                      {"void", reading.isVoid}};
        if (!reading.file.empty()) {
            entry["file"] = reading.file.string();
            entry["column"] = reading.column;
            entry["row"] = reading.row;
        }
        json["layers"].push_back(std::move(entry));
    }
    return json;
}

void printSource(const FileCommandOptions& options, const SourceProbe& probe) {
    fmt::print("\n{}, the top layer first:\n{:28}{:>14}{:>8}  {}\n", options.source.string(), "layer",
               "height, m", "share", "sample: column, row");
    const std::vector<double> shares = planet::sharesOf(*probe.source, probe.readings);
    for (std::size_t i = 0; i < shares.size(); ++i) {
        const planet::SourceReading& reading = probe.readings[i];
        const std::string height = reading.heightM  ? fmt::format("{:.3f}", *reading.heightM)
                                   : reading.isVoid ? "void"
                                                    : "not here";
        const std::string sample = reading.file.empty() ? std::string()
                                                        : fmt::format("{}: {}, {}", reading.file.string(),
                                                                      reading.column, reading.row);
        fmt::print("{:28}{:>14}{:>8}  {}\n", probe.source->layers[reading.layer].name, height,
                   reading.heightM ? fmt::format("{:.3f}", shares[i]) : "", sample);
    }
    if (!planet::topmost(probe.readings))
        fmt::print("No layer has a height here; fill_m is {} m.\n", probe.source->fillM);
}

Json probeJson(const FileCommandOptions& options, const planet::ProbeReport& report) {
    Json json = {{"file", options.file.string()},
                 {"latitude_deg", options.latitudeDeg},
                 {"longitude_deg", options.longitudeDeg},
                 {"face", planet::faceName(report.place.face)},
                 {"u", report.place.u},
                 {"v", report.place.v},
                 {"height_m", report.heightM},
                 {"levels_here", Json::array()}};
    for (const planet::ProbeChunk& chunk : report.chain) {
        const planet::OrientedBox& box = chunk.bounds.box;
        json["levels_here"].push_back(
            {{"id", planet::toString(chunk.id)},
             {"delta_c_m", chunk.deltaCM},
             {"tight_m", chunk.deltaTightM},
             {"height_m", chunk.heightM},
             {"min_height_m", chunk.minHeightM},
             {"max_height_m", chunk.maxHeightM},
             {"box_centre_m", {box.centreM.x, box.centreM.y, box.centreM.z}},
             {"box_half_size_m", {box.halfSizeM.x, box.halfSizeM.y, box.halfSizeM.z}}});
    }
    return json;
}

void printProbe(const FileCommandOptions& options, const planet::ProbeReport& report) {
    fmt::print("{}: {}: height {:.3f} m, face {}, u {:.6f}, v {:.6f}\n\n", options.file.string(),
               placeText(options.latitudeDeg, options.longitudeDeg), report.heightM,
               planet::faceName(report.place.face), report.place.u, report.place.v);
    fmt::print("{:24}{:>14}{:>14}{:>14}{:>14}{:>14}\n", "chunk", "delta_c, m", "tight, m", "height, m",
               "lowest, m", "highest, m");
    for (const planet::ProbeChunk& chunk : report.chain) {
        fmt::print("{:24}{:>14.3f}{:>14.3f}{:>14.3f}{:>14.3f}{:>14.3f}\n", planet::toString(chunk.id),
                   chunk.deltaCM, chunk.deltaTightM, chunk.heightM, chunk.minHeightM, chunk.maxHeightM);
    }
}

}  // namespace

Result<void> runInfo(const FileCommandOptions& options) {
    const Result<ChunkFile> file = ChunkFile::open(options.file);
    if (!file) return tl::unexpected(file.error());
    const Result<planet::FileReport> report = planet::reportFile(*file);
    if (!report) return tl::unexpected(report.error());
    const auto& colour = file->info().colour;
    const Result<ColourLevels> colourLevels = colour ? planet::reportColours(*file) : ColourLevels();
    if (!colourLevels) return tl::unexpected(colourLevels.error());
    if (options.json) {
        Json json = infoJson(*file, *report);
        if (colour) json["colour"] = colourJson(*colour, *colourLevels);
        fmt::print("{}", jsonText(json));
        return {};
    }
    printInfo(*file, *report);
    if (colour) printColour(*colour, *colourLevels);
    return {};
}

Result<bool> runVerify(const FileCommandOptions& options) {
    const Result<ChunkFile> file = ChunkFile::open(options.file);
    if (!file) return tl::unexpected(file.error());
    std::optional<planet::HeightSource> source;
    if (!options.source.empty()) {
        Result<planet::HeightSource> opened = openNamed(options);
        if (!opened) return tl::unexpected(opened.error());
        source = std::move(*opened);
    }
    const InterruptWatch watch;
    const Result<planet::VerifyReport> report =
        planet::verifyFile(*file, source ? &*source : nullptr,
                           [&](std::uint64_t, std::uint64_t) { return !watch.interrupted(); });
    if (!report) return tl::unexpected(report.error());
    const Result<planet::ColourVerifyReport> colours = verifyColoursOf(*file, options, watch);
    if (!colours) return tl::unexpected(colours.error());
    printVerified(options, *report, *colours);
    const std::uint64_t problems = report->problemCount + colours->problemCount;
    if (problems == 0) return true;
    // A file without problems of its own may have been compared with a source that it was not baked from.
    const bool onlySource = problems == report->sourceProblems + colours->sourceProblems;
    printMessage("worldy: {}: {} found, 0 expected; {}\n", options.file.string(), problemsText(problems),
                 onlySource
                     ? "the file is consistent but differs from the given source: bake it again, or name the "
                       "source and the options that it was baked with"
                     : "bake the file again");
    return false;
}

Result<void> runProbe(const FileCommandOptions& options) {
    const Result<ChunkFile> file = ChunkFile::open(options.file);
    if (!file) return tl::unexpected(file.error());
    const planet::Geographic place{glm::radians(options.latitudeDeg),
                                   glm::radians(std::remainder(options.longitudeDeg, 360.0))};
    const Result<planet::ProbeReport> report = planet::probeFile(*file, place);
    if (!report) return tl::unexpected(report.error());
    const Result<std::optional<SourceProbe>> source = probeSource(options, place);
    if (!source) return tl::unexpected(source.error());
    if (options.json) {
        Json json = probeJson(options, *report);
        if (*source) json["source"] = sourceJson(options, **source);
        fmt::print("{}", jsonText(json));
    } else {
        printProbe(options, *report);
        if (*source) printSource(options, **source);
    }
    return {};
}

}  // namespace worldy
