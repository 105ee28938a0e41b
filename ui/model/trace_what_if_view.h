// The state of the What if panel.
#pragma once

#include <string>

#include "app/trace/trace_what_if_job.h"

namespace worldy::ui {

struct TraceWhatIfView {
    bool running = false;
    double progress = 0;                        // [0, 1]
    bool cancelling = false;                    // not finished yet
    std::string problem{};                      // why the last one failed or ended early
    const TraceWhatIfResult* result = nullptr;  // of the last one that finished; null: none
};

}  // namespace worldy::ui
