// Suggests τ for the trace of another engine, by selecting again over its frames (planet/trace/trace_what_if.h), as far as
// the trace's data allow.
#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "app/suggest/suggest_budget.h"
#include "planet/base/result.h"
#include "planet/trace/trace_what_if.h"

namespace worldy {

struct SuggestedForTrace {
    SuggestBudget budget;
    planet::TraceTauSuggestion found;
    // The costs and the error of the engine with its own settings, the largest of all views.
    std::uint64_t engineTriangles = 0;
    std::uint64_t engineBytes = 0;
    double engineErrorPx = 0;  // NaN: not known
    std::uint64_t frames = 0;
};

// The Error names the file, and each budget for which the trace lacks the data, with what is missing; or is of kind
// Cancelled.
planet::Result<SuggestedForTrace> suggestForTrace(const std::filesystem::path& file,
                                                  const SuggestBudget& budget,
                                                  const std::function<bool()>& goOn);

std::string traceVerdictText(const SuggestedForTrace& suggested);
std::string traceMarkdown(const SuggestedForTrace& suggested, const std::filesystem::path& file);
nlohmann::ordered_json traceSuggestJson(const SuggestedForTrace& suggested,
                                        const std::filesystem::path& file);

}  // namespace worldy
