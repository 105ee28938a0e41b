#include "app/editor/paging_controller.h"

#include "app/session/overloaded.h"
#include "planet/planet_tools.h"

namespace worldy {

void execute(PagingController& paging, const ui::PagingCommand& command, Scene* scene, Recorder* recorder,
             bool replaying, const Log& log) {
    const bool pauses = std::holds_alternative<ui::PausePaging>(command);
    if ((!scene && !pauses) || !mayChange("Paging", replaying, log)) return;
    const auto call = [&](FlightCall which, void (planet::PlanetTools::*function)()) {
        (scene->planet->tools().*function)();
        if (recorder) recorder->called(*scene->planet, which);
    };
    std::visit(Overloaded{
                   [&](const ui::PausePaging& pause) { paging.paused = pause.paused; },
                   [&](const ui::LoadOne&) { call(FlightCall::LoadOne, &planet::PlanetTools::loadOne); },
                   [&](const ui::DropAll&) { call(FlightCall::DropAll, &planet::PlanetTools::dropAll); },
                   [&](const ui::RetryFailed& retry) {
                       if (!retry.block)
                           return call(FlightCall::RetryFailed, &planet::PlanetTools::retryFailed);
                       scene->planet->tools().retryFailed(*retry.block);
                       if (recorder) recorder->called(*scene->planet, FlightCall::RetryBlock, *retry.block);
                   },
               },
               command);
}

}  // namespace worldy
