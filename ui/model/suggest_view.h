// The state of the Suggest panel.
#pragma once

#include <span>
#include <string>

#include "app/suggest/suggest_budget.h"
#include "app/suggest/suggest_run.h"
#include "app/suggest/suggest_search.h"

namespace worldy::ui {

struct SuggestView {
    const SuggestOutcome* outcome = nullptr;  // null before the first suggestion, and while one is searched
    std::string planet{};                     // that it is for
    std::string openPlanet{};                 // empty if none is open
    bool fitsPlanet = false;                  // that file is open
    SuggestBudget budget{};                   // of the trials
    int chunkSize = 0;                        // of that planet, vertices per side; 0: no search yet
    std::span<const SuggestTrial> trials{};   // so far, or of the last search
    bool running = false;
    bool cancelling = false;
    SuggestProgress progress{};
    std::string problem{};  // why the last search failed or ended early
};

}  // namespace worldy::ui
