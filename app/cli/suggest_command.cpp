#include "app/cli/suggest_command.h"

#include <fmt/format.h>

#include <unistd.h>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "app/base/interrupt.h"
#include "app/base/message.h"
#include "app/base/output_file.h"
#include "app/base/report.h"
#include "app/base/text.h"
#include "app/data/data_set.h"
#include "app/measure/sweep_files.h"
#include "app/scene/offscreen.h"
#include "app/suggest/suggest_files.h"
#include "app/suggest/suggest_report.h"
#include "app/suggest/suggest_run.h"
#include "app/suggest/suggest_trace.h"
#include "app/trace/trace_document.h"
#include "planet/base/result.h"
#include "planet/base/try.h"
#include "planet/format/chunk_file.h"

namespace worldy {

namespace {

using planet::Result;
namespace fs = std::filesystem;

// Writes the progress to stderr: on a terminal one line that is updated, otherwise a line each time that a part begins.
class SuggestLine {
public:
    ~SuggestLine() {
        if (isOpen_) printMessage("\n");
    }
    void show(const SuggestProgress& progress) {
        if (!isTerminal_) {
            if (std::string part = partText(progress); part != part_) {
                printMessage("{}\n", part);
                part_ = std::move(part);
            }
        } else if (const auto now = std::chrono::steady_clock::now();
                   now - shownAt_ > std::chrono::milliseconds(100)) {
            printMessage("\r\033[K{}", text(progress));
            std::fflush(stderr);
            isOpen_ = true;
            shownAt_ = now;
        }
    }

private:
    static std::string partText(const SuggestProgress& progress) {
        switch (progress.stage) {
            case SuggestStage::Surveying:
                return "surveying the planet";
            case SuggestStage::Baking:
                return fmt::format("baking chunks of {}", progress.candidate.chunkSize);
            case SuggestStage::Timing:
                return "timing frames";
            case SuggestStage::Searching:
                return "searching";
            case SuggestStage::Verifying:
                return "measuring what will be written";
            case SuggestStage::Drawing:
                return "drawing the worst places";
        }
        return "";
    }
    static std::string text(const SuggestProgress& progress) {
        std::string text = fmt::format("{:3.0f} %  {}", 100 * progress.share, partText(progress));
        if (progress.stage != SuggestStage::Searching) return text;
        text += fmt::format("  {} measured, at most {} more: {}", progress.measured, progress.ahead,
                            candidateText(progress.candidate, "tau"));
        if (progress.leftS) text += fmt::format("  {} left", durationText(*progress.leftS));
        return text;
    }

    bool isTerminal_ = ::isatty(STDERR_FILENO) != 0;
    bool isOpen_ = false;
    std::string part_;  // written last, if this is no terminal
    std::chrono::steady_clock::time_point shownAt_{};
};

Result<SuggestRequest> requestFor(const SuggestOptions& options) {
    SuggestRequest request;
    request.file = options.file;
    request.budget = options.budget;
    request.flights = options.flights;
    request.recordings = options.recordings;
    request.stepS = options.stepS;
    request.vary = options.vary;
    request.cost = options.cost;
    request.drawsPictures = options.drawsPictures;
    request.size = options.size;
    request.view = options.view;
    const bool hasFlight = !options.flights.empty() || !options.recordings.empty();
    if (!options.altitudesM.empty() || !hasFlight) {
        planet::AtlasGrid& grid = request.survey.emplace();
        if (!options.altitudesM.empty()) grid.altitudesM = options.altitudesM;
        grid.most = static_cast<std::uint64_t>(options.viewpoints);
    }
    TRY_ASSIGN(request.colourImage, colourImageToDraw(options.file, {}));
    const SuggestFiles files = suggestFilesIn(options.output, options.name);
    request.presetFile = files.preset;
    request.regionsFile = files.regions;
    return request;
}

// Finds the bakes with the other chunk sizes.
Result<SweptFiles> bakesFor(const SuggestOptions& options) {
    if (options.chunkSizes.empty()) return SweptFiles{};
    TRY_ASSIGN(const planet::ChunkFile chunks, planet::ChunkFile::open(options.file));
    std::vector<int> others = options.chunkSizes;
    std::erase(others, planet::chunkSize(chunks.info().shape));
    if (!others.empty() && options.source.empty() && sourceOf(chunks.info()).empty()) {
        return planet::badInput(
            fmt::format("{}: does not say what it was baked from; expected --source, or no --chunk",
                        options.file.string()));
    }
    return sweptFilesOf(options.file, others, options.sourceSettings, options.source);
}

void printSuggestion(const SuggestOutcome& outcome, const std::vector<fs::path>& written) {
    fmt::print("{}\n\n{:<18}{:>20}{:>20}{:>20}  {}\n", verdictText(outcome), "budget", "limit", "before",
               "suggested", "verdict");
    for (const SuggestRow& row : rowsOf(outcome)) {
        fmt::print("{:<18}{:>20}{:>20}{:>20}  {}\n", textOf(row.limit).name,
                   row.budget ? limitText(row.limit, *row.budget) : "none", limitText(row.limit, row.before),
                   limitText(row.limit, row.after), row.verdict);
    }
    fmt::print("\n");
    for (const SettingDifference& change : outcome.changes)
        fmt::print("{}: {} before, {} suggested\n", change.setting, change.here, change.there);
    for (const SuggestEffect& effect : effectsOf(outcome))
        fmt::print("{}: {} before, {} suggested\n", effect.name, effect.before, effect.after);
    for (const SuggestPlace& place : outcome.places) fmt::print("{}: {}\n", placeCaption(place), place.line);
    fmt::print("{}\n", scopeText(outcome));
    if (const std::string times = frameTimeText(outcome); !times.empty()) fmt::print("{}\n", times);
    if (!outcome.noPictures.empty()) fmt::print("{}\n", outcome.noPictures);
    fmt::print("{}\n{}\n", effortText(outcome), chunkSizeText(outcome));
    for (const fs::path& file : written) fmt::print("{}\n", file.string());
}

Result<bool> suggestTrace(const SuggestOptions& options) {
    if (!options.flights.empty() || !options.recordings.empty() || !options.altitudesM.empty()) {
        return planet::badInput(
            fmt::format("{}: is a trace, whose own frames are measured; expected no --flight, --recording "
                        "and --altitudes",
                        options.file.string()));
    }
    const InterruptWatch watch;
    TRY_ASSIGN(const SuggestedForTrace suggested,
               suggestForTrace(options.file, options.budget, [&] { return !watch.interrupted(); }));
    std::error_code status;
    fs::create_directories(options.output, status);  // writing reports a failure
    const fs::path report = suggestFilesIn(options.output, options.name).report;
    TRY(writeTextFile(report, traceMarkdown(suggested, options.file)));
    if (options.json)
        fmt::print("{}", jsonText(traceSuggestJson(suggested, options.file)));
    else
        fmt::print("{}\n{}\n", traceVerdictText(suggested), report.string());
    return suggested.found.isMet;
}

}  // namespace

Result<bool> runSuggestCommand(const SuggestOptions& options) {
    if (isTraceFile(options.file)) return suggestTrace(options);
    TRY_ASSIGN(SuggestRequest request, requestFor(options));
    TRY_ASSIGN(request.bakes, bakesFor(options));
    request.sourceSettings = options.sourceSettings;
    const InterruptWatch watch;
    SuggestOutcome outcome;
    {
        SuggestLine line;
        TRY_ASSIGN(outcome, runSuggest(request, {.progress = [&](const SuggestProgress& progress) {
                                           line.show(progress);
                                           return !watch.interrupted();
                                       }}));
    }
    TRY_ASSIGN(const std::vector<fs::path> written,
               writeSuggestion(outcome, request, options.output, options.name));
    if (options.json)
        fmt::print("{}", jsonText(suggestJson(outcome, request)));
    else
        printSuggestion(outcome, written);
    std::error_code unknown;
    if (outcome.regionsText.empty() && fs::exists(request.regionsFile, unknown)) {
        fmt::print(stderr, "{}: is not of this suggestion, which has no regions, and was left as it is\n",
                   request.regionsFile.string());
    }
    return outcome.isMet;
}

}  // namespace worldy
