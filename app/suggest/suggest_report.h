// The report of a suggestion as Markdown and JSON. Pure functions, any thread.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/suggest/suggest_budget.h"
#include "app/suggest/suggest_run.h"

namespace worldy {

// A budget beside what was measured.
struct SuggestRow {
    SuggestLimit limit = SuggestLimit::FrameMs;
    std::optional<double> budget;
    double before = 0;
    double after = 0;
    std::string
        verdict;  // "met", "exceeded by 12 %", "exceeded 11.5 k-fold", "predicted to be met", "not measured", or "no budget"
};
std::vector<SuggestRow> rowsOf(const SuggestOutcome& outcome);

// Returns "τ 3.1 px, tight, morph range 0.3, 256 MiB". tau: the symbol.
std::string candidateText(const SuggestCandidate& candidate, std::string_view tau);

// Return one or more full sentences: whether the budget is met, what binds and would be needed; what was measured; how
// many measurements it took; and where frame times come from, which is empty if they have no budget.
std::string verdictText(const SuggestOutcome& outcome);
std::string scopeText(const SuggestOutcome& outcome);
std::string effortText(const SuggestOutcome& outcome);
std::string frameTimeText(const SuggestOutcome& outcome);
// Returns whether chunk sizes were tried, and which bake is suggested.
std::string chunkSizeText(const SuggestOutcome& outcome);
// Returns the last four together.
std::string methodText(const SuggestOutcome& outcome);
// Returns what it costs and leaves besides the budgets, before and after.
struct SuggestEffect {
    std::string name, before, after;
};
std::vector<SuggestEffect> effectsOf(const SuggestOutcome& outcome);
// Returns "Drawn error 1.42 px at 46.5° N, 7.9° E, 12.3 km up".
std::string placeCaption(const SuggestPlace& place);

// Returns the report of a page. name: of the files of the suggestion, without their endings. hasPicture: NAME.png is there.
std::string suggestMarkdown(const SuggestOutcome& outcome, const SuggestRequest& request,
                            const std::string& name, bool hasPicture);
nlohmann::ordered_json suggestJson(const SuggestOutcome& outcome, const SuggestRequest& request);

}  // namespace worldy
