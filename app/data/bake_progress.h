// A bake's progress on the terminal.
#pragma once

#include "app/data/bake_job.h"
#include "planet/bake/bake.h"

namespace worldy {

// Where stderr is a terminal, one line that is written over; elsewhere a line for every tenth.
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

// Bakes with progress on the terminal until it ends or is interrupted.
planet::Result<planet::BakeReport> bakeOnTerminal(const planet::HeightSource& source,
                                                  const planet::BakeSettings& settings,
                                                  const std::filesystem::path& output,
                                                  const planet::ColourSource* colour = nullptr);
// Bakes with the colours of an image. Prints its notice, and why it failed where it may fail.
planet::Result<planet::BakeReport> bakeOnTerminal(const planet::HeightSource& source,
                                                  const planet::BakeSettings& settings,
                                                  const std::filesystem::path& output,
                                                  const JobColour& colour);

}  // namespace worldy
