// The state of the comparison of the open trace with a second one.
#pragma once

#include <filesystem>
#include <string>

#include "app/trace/trace_compare_job.h"

namespace worldy::ui {

struct TraceComparedView {
    bool running = false;
    int runs = 0;                   // comparisons that were started
    double progress = 0;            // [0, 1]
    bool cancelling = false;        // not finished yet
    std::string problem{};          // why the last one failed, ended early or found nothing
    std::filesystem::path fileB{};  // of the last one that was asked for; empty: none was
    planet::TraceMatch match = planet::TraceMatch::Time;  // the same
    const TraceCompared* result = nullptr;                // of the last one that finished; null: none
};

}  // namespace worldy::ui
