// The Suggest panel's commands: searches settings for a budget in the background, applies and saves them. Main thread.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/base/log.h"
#include "app/editor/settings_controller.h"
#include "app/session/notices.h"
#include "app/session/session.h"
#include "app/suggest/suggest_job.h"
#include "app/suggest/suggest_run.h"
#include "app/suggest/suggest_search.h"
#include "ui/model/commands.h"
#include "ui/model/suggest_view.h"

namespace worldy {

// A search keeps using the chunk file that it started with: the planet may be closed or rebaked while it runs.
struct SuggestController {
    std::unique_ptr<SuggestJob> job{};  // at most one
    SuggestRequest request{};           // of the job, or of the last one
    std::string planet{};               // of the request, as the window names it
    int chunkSize = 0;                  // of that planet
    std::vector<SuggestTrial> trials{};
    std::optional<SuggestOutcome> outcome{};
    std::string problem{};
    bool cancelled = false;  // the problem is that the user cancelled
};

struct SuggestContext {
    Session& session;
    SettingsController& settings;
    bool replaying = false;  // settings then stay as they are
};
void execute(SuggestController& controller, const ui::SuggestCommand& command, const SuggestContext& context,
             Notices& notices);

// Call every frame; takes trials and the result of a search.
void advanceSuggest(SuggestController& controller, const Log& log);

// Returns the settings now with those that a suggestion chose, and with the regions that it adds to those of now.
ViewSettings settingsToApply(const ViewSettings& now, const SuggestOutcome& outcome);

// open: the shown planet; null if there is none.
ui::SuggestView suggestViewOf(const SuggestController& controller, const OpenPlanet* open);

}  // namespace worldy
