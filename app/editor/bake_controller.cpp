#include "app/editor/bake_controller.h"

#include "app/editor/overloaded.h"

namespace worldy {

void execute(Session& session, const ui::BakeCommand& command, ui::BakePanelState& panel, const Log& log) {
    std::visit(
        Overloaded{
            [&](const ui::ChooseColourImage& image) { panel.colour.chosen = image.file; },
            [&](const ui::StartBake& bake) { startBake(session, bake.request, log); },
            [&](const ui::BakeAgain&) { startBake(session, log); },
            [&](const ui::EstimateBake& estimate) { requestEstimate(session, estimate.request); },
            [&](const ui::CancelBake&) { cancelBake(session); },
            [&](const ui::PreviewSource& preview) { requestPreview(session.preview, preview.request); },
            [&](const ui::ShowPreviousBake& previous) { showPreviousBake(session, previous.shown); },
            [&](const ui::DismissPreviousBake&) { dismissPreviousBake(session); },
        },
        command);
}

}  // namespace worldy
