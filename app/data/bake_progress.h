// Shows the progress of a bake or a survey on the terminal.
#pragma once

#include <string>

#include "app/data/bake_job.h"
#include "planet/bake/bake.h"
#include "planet/bake/job/bake_job.h"
#include "planet/measure/atlas_run.h"

namespace worldy {

// Writes to stderr: on a terminal one line that is updated, otherwise one line per tenth. As JSON, it writes an object a
// line each time, for a program that reads it.
class TerminalProgress {
public:
    explicit TerminalProgress(bool asJson = false);
    ~TerminalProgress();
    TerminalProgress(const TerminalProgress&) = delete;
    TerminalProgress& operator=(const TerminalProgress&) = delete;

    void show(const planet::BakeProgress& progress);
    void show(const planet::JobProgress& progress);
    void show(const planet::AtlasProgress& progress);

private:
    void showLine(double share, const std::string& text);

    bool asJson_;
    bool terminal_ = false;
    bool lineOpen_ = false;
    int tenthsShown_ = 0;
};

// Returns "12 of 30 chunks copied", and the colour tiles if they were copied.
std::string copiedText(const planet::BakeReport& report);
// Returns BakeReport::reuseNotice with what was done about it.
std::string reuseText(const planet::BakeReport& report);

// Bakes with progress on the terminal, until the bake ends or is interrupted.
planet::Result<planet::BakeReport> bakeOnTerminal(const planet::HeightSource& source,
                                                  const planet::BakeSettings& settings,
                                                  const std::filesystem::path& output,
                                                  const planet::ColourSource* colour = nullptr,
                                                  bool progressAsJson = false);
// Bakes with other ranks, which all call it; rank 0 shows the progress of all.
planet::Result<planet::JobReport> bakeJobOnTerminal(planet::Ranks& ranks, const planet::HeightSource& source,
                                                    const planet::JobSettings& settings,
                                                    const std::filesystem::path& output,
                                                    const planet::ColourSource* colour, bool progressAsJson);
// Also takes the colours of an image. Prints the colour notice of the bake, and why an image that may fail
// did fail.
planet::Result<planet::BakeReport> bakeOnTerminal(const planet::HeightSource& source,
                                                  const planet::BakeSettings& settings,
                                                  const std::filesystem::path& output,
                                                  const JobColour& colour);

}  // namespace worldy
