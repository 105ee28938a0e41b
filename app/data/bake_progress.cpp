#include "app/data/bake_progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>

#include "app/base/interrupt.h"
#include "app/base/message.h"
#include "app/base/text.h"

namespace worldy {

namespace {

std::string progressText(const planet::BakeProgress& progress, double share) {
    return fmt::format("{:3.0f} %  {} of {} samples  {} samples/s  {} left", 100 * share,
                       countText(static_cast<double>(progress.samplesDone)),
                       countText(static_cast<double>(progress.samplesTotal)), countText(progress.samplesPerS),
                       durationText(progress.remainingS));
}

std::string progressText(const planet::JobProgress& progress, double share) {
    std::string text =
        fmt::format("{:3.0f} %  {} of {} units", 100 * share, progress.unitsDone, progress.unitsTotal);
    if (progress.bake.samplesPerS == 0) return text;  // it has just begun
    text += fmt::format("  {} samples/s  {} left", countText(progress.bake.samplesPerS),
                        durationText(progress.bake.remainingS));
    if (progress.ranks > 1)
        text += fmt::format("  slowest of {} ranks: {}, {} samples/s", progress.ranks, progress.slowestRank,
                            countText(progress.slowestSamplesPerS));
    return text;
}

double shareOf(const planet::BakeProgress& progress) {
    return static_cast<double>(progress.samplesDone) / static_cast<double>(progress.samplesTotal);
}

nlohmann::ordered_json progressJson(const planet::BakeProgress& progress) {
    return {{"samples_done", progress.samplesDone},
            {"samples_total", progress.samplesTotal},
            {"elapsed_s", progress.elapsedS},
            {"samples_per_s", progress.samplesPerS},
            {"remaining_s", progress.remainingS}};
}

nlohmann::ordered_json progressJson(const planet::JobProgress& progress) {
    nlohmann::ordered_json json = progressJson(progress.bake);
    json["units_done"] = progress.unitsDone;
    json["units_total"] = progress.unitsTotal;
    json["ranks"] = progress.ranks;
    json["slowest_rank"] = progress.slowestRank;
    json["slowest_samples_per_s"] = progress.slowestSamplesPerS;
    return json;
}

// Calls bake with a callback that shows the progress and returns false once the bake is interrupted.
template <class Progress, class Bake>
auto withProgress(bool asJson, const Bake& bake) {
    const InterruptWatch watch;
    TerminalProgress line(asJson);
    return bake([&](const Progress& progress) {
        line.show(progress);
        return !watch.interrupted();
    });
}

}  // namespace

TerminalProgress::TerminalProgress(bool asJson) : asJson_(asJson), terminal_(::isatty(STDERR_FILENO) != 0) {}

TerminalProgress::~TerminalProgress() {
    if (lineOpen_) printMessage("\n");
}

void TerminalProgress::show(const planet::BakeProgress& progress) {
    if (progress.samplesTotal == 0) return;
    showLine(shareOf(progress),
             asJson_ ? progressJson(progress).dump() : progressText(progress, shareOf(progress)));
}

void TerminalProgress::show(const planet::JobProgress& progress) {
    if (progress.bake.samplesTotal == 0) return;
    showLine(shareOf(progress.bake),
             asJson_ ? progressJson(progress).dump() : progressText(progress, shareOf(progress.bake)));
}

void TerminalProgress::show(const planet::AtlasProgress& progress) {
    if (progress.since == 0) return;
    const double perS = static_cast<double>(progress.since) / progress.elapsedS;
    const double share = static_cast<double>(progress.done) / static_cast<double>(progress.total);
    showLine(share, fmt::format("{:3.0f} %  {} of {} viewpoints  {:.1f} viewpoints/s  {} left", 100 * share,
                                progress.done, progress.total, perS,
                                durationText(static_cast<double>(progress.total - progress.done) / perS)));
}

void TerminalProgress::showLine(double share, const std::string& text) {
    if (asJson_) {
        printMessage("{}\n", text);
        std::fflush(stderr);
        return;
    }
    if (terminal_) {
        printMessage("\r\033[K{}", text);
        std::fflush(stderr);
        lineOpen_ = true;
        return;
    }
    const int tenths = static_cast<int>(10 * share);
    if (tenths <= tenthsShown_) return;
    printMessage("{}\n", text);
    tenthsShown_ = tenths;
}

std::string copiedText(const planet::BakeReport& report) {
    std::string text = fmt::format("{} of {} chunks", report.copiedChunks, report.chunks);
    if (report.copiedColourTiles > 0)
        text += fmt::format(" and {} of {} colour tiles", report.copiedColourTiles, report.colourTiles);
    return text + " copied";
}

std::string reuseText(const planet::BakeReport& report) {
    if (!report.reuseIsDamaged) return report.reuseNotice;
    return report.reuseNotice + "; what it holds there was baked instead of copied";
}

planet::Result<planet::BakeReport> bakeOnTerminal(const planet::HeightSource& source,
                                                  const planet::BakeSettings& settings,
                                                  const std::filesystem::path& output,
                                                  const planet::ColourSource* colour, bool progressAsJson) {
    return withProgress<planet::BakeProgress>(progressAsJson, [&](const planet::BakeProgressCallback& show) {
        return planet::bake(source, settings, output, show, colour);
    });
}

planet::Result<planet::JobReport> bakeJobOnTerminal(planet::Ranks& ranks, const planet::HeightSource& source,
                                                    const planet::JobSettings& settings,
                                                    const std::filesystem::path& output,
                                                    const planet::ColourSource* colour, bool progressAsJson) {
    return withProgress<planet::JobProgress>(progressAsJson, [&](const planet::JobProgressCallback& show) {
        return planet::bakeJob(ranks, source, settings, output, show, colour);
    });
}

planet::Result<planet::BakeReport> bakeOnTerminal(const planet::HeightSource& source,
                                                  const planet::BakeSettings& settings,
                                                  const std::filesystem::path& output,
                                                  const JobColour& colour) {
    std::string problem;
    planet::Result<planet::BakeReport> report =
        withProgress<planet::BakeProgress>(false, [&](const planet::BakeProgressCallback& show) {
            return bakeWithColour(source, settings, output, show, colour, problem);
        });
    if (!problem.empty()) printMessage("worldy: {}; baked without colours\n", problem);
    if (report && !report->colourNotice.empty()) printMessage("worldy: {}\n", report->colourNotice);
    if (report && !report->quantumNotice.empty()) printMessage("worldy: {}\n", report->quantumNotice);
    return report;
}

}  // namespace worldy
