// Executes the Bake panel's commands, and owns estimates, previews and what is known of the planet's source. The session
// owns the bake. Main thread.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/base/log.h"
#include "app/data/bake_job.h"
#include "app/data/source_preview.h"
#include "app/data/worlds.h"
#include "app/editor/source_controller.h"
#include "app/session/session.h"
#include "ui/model/commands.h"
#include "ui/panels/bake/bake_panel.h"

namespace worldy {

// The estimate of the last requested bake.
struct BakeEstimator {
    std::unique_ptr<EstimateJob> job;
    std::optional<BakeRequest> next;  // requested while another one was running
    std::optional<planet::BakeEstimate> result;
    std::string problem;
};
// Replaces the previous request.
void requestEstimate(BakeEstimator& estimator, const BakeRequest& request);
// Call once per frame.
void advanceEstimate(BakeEstimator& estimator);

struct BakeController {
    BakeEstimator estimator;
    SourcePreviewer preview;
    std::vector<World> worlds = worldy::worlds();
    SourceController sources;
};

void execute(BakeController& controller, const ui::BakeCommand& command, Session& session,
             ui::BakePanelState& panel, const Log& log);

// Valid for the frame.
ui::BakeView bakeViewOf(const BakeController& controller, const Session& session);

}  // namespace worldy
