#include "app/editor/bake_controller.h"

#include <utility>

#include "app/editor/instrument_views.h"
#include "app/session/overloaded.h"

namespace worldy {

void requestEstimate(BakeEstimator& estimator, const BakeRequest& request) {
    estimator.next = request;
    estimator.result.reset();
    estimator.problem.clear();
    if (estimator.job) estimator.job->cancel();
}

void advanceEstimate(BakeEstimator& estimator) {
    if (estimator.job) {
        const std::optional<planet::Result<planet::BakeEstimate>> result = estimator.job->takeResult();
        if (!result) return;
        estimator.job.reset();
        // The result is discarded if a newer request waits.
        if (!estimator.next) {
            estimator.result = *result ? std::optional(**result) : std::nullopt;
            estimator.problem = *result ? std::string() : result->error().message;
        }
    }
    if (!estimator.next) return;
    estimator.job = std::make_unique<EstimateJob>(*std::exchange(estimator.next, std::nullopt));
}

void execute(BakeController& controller, const ui::BakeCommand& command, Session& session,
             ui::BakePanelState& panel, const Log& log) {
    std::visit(
        Overloaded{
            [&](const ui::ChooseColourImage& image) { panel.colour.chosen = image.file; },
            [&](const ui::StartBake& bake) { startBake(session, bake.request, log); },
            [&](const ui::BakeAgain&) { startBake(session, log); },
            [&](const ui::EstimateBake& bake) { requestEstimate(controller.estimator, bake.request); },
            [&](const ui::CancelBake&) { cancelBake(session); },
            [&](const ui::PreviewSource& source) { requestPreview(controller.preview, source.request); },
            [&](const ui::ShowPreviousBake& previous) { showPreviousBake(session, previous.shown); },
            [&](const ui::DismissPreviousBake&) { dismissPreviousBake(session); },
        },
        command);
}

ui::BakeView bakeViewOf(const BakeController& controller, const Session& session) {
    ui::BakeView view = bakeViewOf(session);
    view.estimating = controller.estimator.job || controller.estimator.next;
    view.estimate = controller.estimator.result;
    view.estimateProblem = controller.estimator.problem;
    view.worlds = controller.worlds;
    view.preview = previewViewOf(controller.preview);
    return view;
}

}  // namespace worldy
