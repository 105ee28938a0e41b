#include "app/data/bake_progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
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

// Calls bake with a callback that shows the progress and returns false once the bake is interrupted.
template <class Bake>
planet::Result<planet::BakeReport> withProgress(const Bake& bake) {
    const InterruptWatch watch;
    TerminalProgress line;
    return bake([&](const planet::BakeProgress& progress) {
        line.show(progress);
        return !watch.interrupted();
    });
}

}  // namespace

TerminalProgress::TerminalProgress() : terminal_(::isatty(STDERR_FILENO) != 0) {}

TerminalProgress::~TerminalProgress() {
    if (lineOpen_) printMessage("\n");
}

void TerminalProgress::show(const planet::BakeProgress& progress) {
    if (progress.samplesTotal == 0) return;
    const double share =
        static_cast<double>(progress.samplesDone) / static_cast<double>(progress.samplesTotal);
    if (terminal_) {
        printMessage("\r\033[K{}", progressText(progress, share));
        std::fflush(stderr);
        lineOpen_ = true;
        return;
    }
    const int tenths = static_cast<int>(10 * share);
    if (tenths <= tenthsShown_) return;
    printMessage("{}\n", progressText(progress, share));
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
                                                  const planet::ColourSource* colour) {
    return withProgress([&](const planet::BakeProgressCallback& show) {
        return planet::bake(source, settings, output, show, colour);
    });
}

planet::Result<planet::BakeReport> bakeOnTerminal(const planet::HeightSource& source,
                                                  const planet::BakeSettings& settings,
                                                  const std::filesystem::path& output,
                                                  const JobColour& colour) {
    std::string problem;
    planet::Result<planet::BakeReport> report = withProgress([&](const planet::BakeProgressCallback& show) {
        return bakeWithColour(source, settings, output, show, colour, problem);
    });
    if (!problem.empty()) printMessage("worldy: {}; baked without colours\n", problem);
    if (report && !report->colourNotice.empty()) printMessage("worldy: {}\n", report->colourNotice);
    if (report && !report->quantumNotice.empty()) printMessage("worldy: {}\n", report->quantumNotice);
    return report;
}

}  // namespace worldy
