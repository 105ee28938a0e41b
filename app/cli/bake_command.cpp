#include "app/cli/bake_command.h"

#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "app/base/exit_code.h"
#include "app/base/message.h"
#include "app/base/process_memory.h"
#include "app/base/report.h"
#include "app/base/text.h"
#include "app/data/bake_progress.h"
#include "app/data/bake_ranks.h"
#include "app/data/worlds.h"
#include "planet/bake/job/shared_opening.h"
#include "planet/bake/job/team.h"
#include "planet/base/stopwatch.h"
#include "planet/source/colour_source.h"
#include "planet/source/terrain.h"

namespace worldy {

namespace {

// The sources that are baked, which are open.
struct BakeInputs {
    planet::BakeSettings settings;
    planet::HeightSource source;
    std::optional<planet::ColourSource> colour;
    double openS = 0;               // how long it took to open them
    std::vector<double> surveyS{};  // of it, how long each rank read its part of the samples
};

double bitsPerSample(const planet::BakeReport& report) {
    return report.samples == 0 ? 0
                               : 8.0 * static_cast<double>(report.fileBytes - report.colourBytes) /
                                     static_cast<double>(report.samples);
}

// Returns how often each sample of the source's rasters was read, on average; nothing if there are none.
std::optional<double> readsPerSample(const planet::HeightSource& source) {
    if (!source.reads) return std::nullopt;
    const planet::SourceReads reads = source.reads();
    if (reads.samples == 0) return std::nullopt;
    return static_cast<double>(reads.read) / static_cast<double>(reads.samples);
}

nlohmann::ordered_json jsonOf(const planet::RankReport& rank, double surveyS) {
    return {{"name", rank.name},
            {"threads", rank.threads},
            {"survey_s", surveyS},
            {"units", rank.units},
            {"samples", rank.samples},
            {"bake_s", rank.bakeS},
            {"join_s", rank.joinS},
            {"wait_s", rank.waitS},
            {"spooled_bytes", rank.spooledBytes},
            {"written_bytes", rank.writtenBytes},
            {"peak_memory_bytes", rank.peakMemoryBytes}};
}

// job: null if it was baked alone.
void printJson(const BakeInputs& inputs, const BakeOptions& options, const planet::BakeReport& report,
               const planet::JobReport* job) {
    const planet::HeightSource& source = inputs.source;
    const std::optional<double> reads = readsPerSample(source);
    nlohmann::ordered_json json = {{"source", source.description},
                                   {"output", options.output.string()},
                                   {"face_size", planet::faceCells(report.shape) + 1},
                                   {"chunk_size", planet::chunkSize(report.shape)},
                                   {"level_count", planet::deepestLevelOf(report.shape) + 1},
                                   {"radius_m", report.shape.radiusM},
                                   {"quantum_m", fileQuantumM(report.shape)},
                                   {"finest_quantum_m", report.shape.quantumM},
                                   {"samples", report.samples},
                                   {"chunks", report.chunks},
                                   {"coarsest_leaf_level", report.coarsestLeafLevel},
                                   {"file_bytes", report.fileBytes},
                                   {"bits_per_sample", bitsPerSample(report)},
                                   {"missing_samples", report.missingSamples},
                                   {"skipped", source.skipped},
                                   {"root_delta_c_m", report.largestDeltaCM},
                                   {"root_tight_m", report.largestDeltaTightM},
                                   {"colour_tiles", report.colourTiles},
                                   {"colour_bytes", report.colourBytes},
                                   {"colour_notice", report.colourNotice},
                                   {"quantum_notice", report.quantumNotice},
                                   {"reuse", options.settings.reuse.string()},
                                   {"copied_chunks", report.copiedChunks},
                                   {"copied_colour_tiles", report.copiedColourTiles},
                                   {"sampled_cells", report.sampledCells},
                                   {"reuse_notice", report.reuseNotice},
                                   {"reads_per_sample", reads ? nlohmann::ordered_json(*reads) : nullptr},
                                   {"peak_memory_bytes", peakProcessBytes()},
                                   {"seconds", report.seconds}};
    if (job) {
        json["open_s"] = inputs.openS;
        json["plan_s"] = job->planS;
        json["units"] = job->units;
        json["resumed_units"] = job->resumedUnits;
        json["ranks"] = nlohmann::ordered_json::array();
        for (std::size_t i = 0; i < job->ranks.size(); ++i)
            json["ranks"].push_back(jsonOf(job->ranks[i], inputs.surveyS[i]));
        json["finished_units"] = nlohmann::ordered_json::array();
        for (const planet::SpoolEntry& unit : job->finished)
            json["finished_units"].push_back(
                {unit.done.samples, unit.done.seconds, unit.frontBytes + unit.bodyBytes});
    }
    fmt::print("{}", jsonText(json));
}

void printRanks(const planet::JobReport& job) {
    fmt::print("{} units, of which {} were finished before\n", job.units, job.resumedUnits);
    for (const planet::RankReport& rank : job.ranks) {
        fmt::print(
            "{}, {} threads: {} units, {} samples, baked {}, joined {}, of which it waited {}; {} of "
            "memory\n",
            rank.name, rank.threads, rank.units, countText(static_cast<double>(rank.samples)),
            durationText(rank.bakeS), durationText(rank.joinS), durationText(rank.waitS),
            bytesText(static_cast<double>(rank.peakMemoryBytes)));
    }
}

void printText(const BakeInputs& inputs, const BakeOptions& options, const planet::BakeReport& report,
               const planet::JobReport* job) {
    const planet::HeightSource& source = inputs.source;
    fmt::print("{}\n", source.description);
    fmt::print("{}: {} levels, {} chunks of {} x {}, faces of {} x {}\n", options.output.string(),
               planet::deepestLevelOf(report.shape) + 1, report.chunks, planet::chunkSize(report.shape),
               planet::chunkSize(report.shape), planet::faceCells(report.shape) + 1,
               planet::faceCells(report.shape) + 1);
    if (report.coarsestLeafLevel < planet::deepestLevelOf(report.shape)) {
        fmt::print("{} leaves on levels {} to {}, as fine as the sources\n",
                   planet::leafCountOf(report.chunks), report.coarsestLeafLevel,
                   planet::deepestLevelOf(report.shape));
    }
    if (report.shape.fractionBits > 0) {
        fmt::print("heights in steps of {} m, down to {} m where the source is finer\n",
                   fileQuantumM(report.shape), report.shape.quantumM);
    }
    fmt::print("{} samples, {}, {:.2f} bits per finest sample, {}\n", report.samples,
               bytesText(static_cast<double>(report.fileBytes)), bitsPerSample(report),
               durationText(report.seconds));
    if (const std::optional<double> reads = readsPerSample(source)) {
        fmt::print(
            "each sample of the rasters was read {:.2f} times, the first time for their range; {} of "
            "memory\n",
            *reads, bytesText(static_cast<double>(peakProcessBytes())));
    }
    if (report.colourTiles > 0) {
        fmt::print("{} colour tiles, {}\n", report.colourTiles,
                   bytesText(static_cast<double>(report.colourBytes)));
    }
    if (!options.settings.reuse.empty()) {
        fmt::print("{} from {}\n", copiedText(report), options.settings.reuse.string());
    }
    fmt::print("max root error: delta_c {}, tight {}\n",
               distanceText(static_cast<double>(report.largestDeltaCM)),
               distanceText(static_cast<double>(report.largestDeltaTightM)));
    if (job) printRanks(*job);
}

void printWarnings(const planet::HeightSource& source, const BakeOptions& options,
                   const planet::BakeReport& report) {
    for (const std::string& message : source.skipped) printMessage("worldy: skipped {}\n", message);
    if (report.missingSamples > 0) {
        const std::string instead = planet::isWorldFile(options.source)
                                        ? "its layers say what they show"
                                        : fmt::format("filled with {} m", options.sourceSettings.fillM);
        printMessage("worldy: {}: {} samples have no data; {}\n", options.source.string(),
                     report.missingSamples, instead);
    }
    if (!report.colourNotice.empty()) printMessage("worldy: {}\n", report.colourNotice);
    if (!report.quantumNotice.empty()) printMessage("worldy: {}\n", report.quantumNotice);
    if (!report.reuseNotice.empty()) printMessage("worldy: {}\n", reuseText(report));
}

void printField(const planet::TerrainField& field, const planet::TerrainSettings& defaults) {
    fmt::print("    {:<14} {:>8} {:<3} [{}, {}]{}\n", field.name, fmt::format("{}", field.get(defaults)),
               field.unit, field.least, field.most, field.whole ? ", integer" : "");
}

// Prints the worlds and the kinds of procedural terrain with their settings.
void printPresets() {
    fmt::print("Presets: worldy bake preset:NAME -o OUT.chk\n");
    for (const World& world : worlds()) {
        const planet::BakeSettings& settings = world.request.settings;
        fmt::print("  {:<16} {}\n{:19}{}, radius {} km{}\n", world.name, world.about, "",
                   world.request.source.string(), settings.radiusM / 1000,
                   settings.faceSize ? fmt::format(", faces of {}", *settings.faceSize) : "");
    }
    fmt::print("\nProcedural terrain: worldy bake KIND,NAME=VALUE,... -o OUT.chk; defaults and ranges are\n");
    for (const planet::TerrainKind& kind : planet::terrainKinds()) {
        const bool isDetail = kind.name == "detail";
        fmt::print("  {:<16} {}\n", isDetail ? "detail:...,of=" : kind.name, kind.about);
        for (const planet::TerrainField& field : kind.fields) printField(field, kind.defaults);
    }
}

// Returns the source with its added detail, and the settings.
planet::Result<NamedSource> sourceFrom(const BakeOptions& options) {
    planet::Result<NamedSource> named = sourceNamed(options.source, options.settings);
    if (!named) return named;
    if (options.radiusM) named->settings.radiusM = *options.radiusM;
    if (!options.detail) return named;
    const std::string parameters = options.detail->empty() ? "" : *options.detail + ",";
    const std::string text = fmt::format("detail:{}of={}", parameters, named->source.string());
    const planet::Result<planet::TerrainSource> good = planet::terrainFromText(text);
    if (!good) return tl::unexpected(good.error());
    named->source = text;
    return named;
}

// share: of a rank; null if it bakes alone.
planet::Result<BakeInputs> openInputs(const BakeOptions& options,
                                      const std::shared_ptr<const planet::SurveyShare>& share = {}) {
    const planet::Stopwatch stopwatch;
    const std::filesystem::path& reuse = options.settings.reuse;
    std::error_code unknown;
    if (!reuse.empty() && !std::filesystem::exists(reuse, unknown)) {
        return planet::ioError(
            fmt::format("{}: no such file; expected an earlier bake to copy from", reuse.string()));
    }
    planet::Result<NamedSource> named = sourceFrom(options);
    if (!named) return tl::unexpected(named.error());
    planet::HeightSourceSettings sourceSettings = options.sourceSettings;
    sourceSettings.share = share;
    planet::Result<planet::HeightSource> source = planet::openHeightSource(named->source, sourceSettings);
    if (!source) return tl::unexpected(source.error());
    BakeInputs inputs{named->settings, *std::move(source), {}, 0};
    const bool hasOwn = options.colour.empty() && planet::hasColourLayers(named->source);
    if (hasOwn || !options.colour.empty()) {
        planet::Result<planet::ColourSource> opened = planet::openColourSource(
            hasOwn ? named->source : options.colour, planet::defaultColourCacheBytes, share);
        if (!opened) return tl::unexpected(opened.error());
        inputs.colour = *std::move(opened);
    }
    inputs.openS = stopwatch.elapsedS();
    return inputs;
}

void printReport(const BakeInputs& inputs, const BakeOptions& options, const planet::BakeReport& report,
                 const planet::JobReport* job = nullptr) {
    printWarnings(inputs.source, options, report);
    (options.json ? printJson : printText)(inputs, options, report, job);
}

planet::Result<void> bakeWithOthers(const BakeOptions& options, planet::Ranks& ranks) {
    planet::Team team(ranks);
    const planet::Result<std::string> program = programBuild();
    planet::SharedOpening opening(team, program.value_or(""));
    planet::Result<BakeInputs> inputs = openInputs(options, opening.share());
    std::vector<double> surveyS = opening.finish();
    if (inputs) inputs->surveyS = std::move(surveyS);
    planet::Result<void> ready;
    if (!inputs) ready = tl::unexpected(inputs.error());
    if (!program) ready = tl::unexpected(program.error());
    if (ready = team.agree(ready); !ready) return ready;
    const planet::Result<planet::JobReport> report =
        bakeJobOnTerminal(ranks, inputs->source, {inputs->settings, options.resume, *program}, options.output,
                          inputs->colour ? &*inputs->colour : nullptr, options.progressJson);
    if (!report) return tl::unexpected(report.error());
    if (team.rank() == 0) printReport(*inputs, options, report->bake, &*report);
    return {};
}

}  // namespace

planet::Result<void> runBake(const BakeOptions& options) {
    if (options.listPresets) {
        printPresets();
        return {};
    }
    if (isOneOfSeveralRanks() || options.resume) {
        const planet::Result<std::unique_ptr<planet::Ranks>> ranks = joinRanks();
        if (!ranks) return tl::unexpected(ranks.error());
        return bakeWithOthers(options, **ranks).map_error([&](planet::Error error) {
            // The first rank that exits with an error ends the others. None exits before rank 0 has written the
            // message, because they wait for it in MPI_Finalize.
            if ((*ranks)->rank() == 0) reportError(error);
            error.message.clear();
            return error;
        });
    }
    const planet::Result<BakeInputs> inputs = openInputs(options);
    if (!inputs) return tl::unexpected(inputs.error());
    const planet::Result<planet::BakeReport> report =
        bakeOnTerminal(inputs->source, inputs->settings, options.output,
                       inputs->colour ? &*inputs->colour : nullptr, options.progressJson);
    if (!report) return tl::unexpected(report.error());
    printReport(*inputs, options, *report);
    return {};
}

}  // namespace worldy
