// The Bake panel's commands. The session bakes; estimates and previews are kept here. Main thread.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/base/log.h"
#include "app/data/bake_job.h"
#include "app/data/source_preview.h"
#include "app/data/worlds.h"
#include "app/editor/session.h"
#include "ui/model/commands.h"
#include "ui/panels/bake/bake_panel.h"

namespace worldy {

// An estimate of the bake that was last asked about.
struct BakeEstimator {
    std::unique_ptr<EstimateJob> job;
    std::optional<BakeRequest> next;  // asked about while another one ran
    std::optional<planet::BakeEstimate> result;
    std::string problem;
};
// Replaces what was asked before.
void requestEstimate(BakeEstimator& estimator, const BakeRequest& request);
// Once a frame.
void advanceEstimate(BakeEstimator& estimator);

struct BakeController {
    BakeEstimator estimator;
    SourcePreviewer preview;
    std::vector<World> worlds = worldy::worlds();
};

void execute(BakeController& controller, const ui::BakeCommand& command, Session& session,
             ui::BakePanelState& panel, const Log& log);

// Holds for the frame.
ui::BakeView bakeViewOf(const BakeController& controller, const Session& session);

}  // namespace worldy
