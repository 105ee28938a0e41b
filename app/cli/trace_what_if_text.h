// The what-if part of the command worldy trace: tables and JSON of selections with other settings (trace_what_if.h).
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "planet/base/result.h"
#include "planet/trace/trace_what_if.h"

namespace worldy {

// Parses "error_px=1.5,bytes_mb=16,triangles=100000", one of them or more, each > 0; a MB is 10^6 bytes.
planet::Result<planet::TraceTauGoal> traceTauGoalFromText(const std::string& text);

// The findings. Either part can be missing.
struct TraceWhatIfFound {
    planet::TraceWhatIfReport report{};
    planet::TraceTauGoal goal{};
    std::optional<planet::TraceTauSuggestion> suggestion{};
};

// worst: disagreements to list, >= 0.
void printWhatIf(const TraceWhatIfFound& found, int worst);
nlohmann::ordered_json whatIfJson(const TraceWhatIfFound& found);

}  // namespace worldy
