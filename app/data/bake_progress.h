// Shows the progress of a bake on the terminal.
#pragma once

#include <string>

#include "app/data/bake_job.h"
#include "planet/bake/bake.h"

namespace worldy {

// Writes to stderr: on a terminal one line that is updated, otherwise one line per tenth.
class TerminalProgress {
public:
    TerminalProgress();
    ~TerminalProgress();
    TerminalProgress(const TerminalProgress&) = delete;
    TerminalProgress& operator=(const TerminalProgress&) = delete;

    void show(const planet::BakeProgress& progress);

private:
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
                                                  const planet::ColourSource* colour = nullptr);
// Also takes the colours of an image. Prints the colour notice of the bake, and why an image that may fail
// did fail.
planet::Result<planet::BakeReport> bakeOnTerminal(const planet::HeightSource& source,
                                                  const planet::BakeSettings& settings,
                                                  const std::filesystem::path& output,
                                                  const JobColour& colour);

}  // namespace worldy
