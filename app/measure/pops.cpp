#include "app/measure/pops.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace worldy {

void forgetPops(Pops& pops) {
    const bool measuring = pops.measuring;
    pops = {};
    pops.measuring = measuring;
}

void measurePops(const Scene& scene, const planet::View& view, double timeS, bool cameraJumped, Pops& pops) {
    if (!pops.measuring) {
        pops.interrupted = true;
        return;
    }
    const bool interrupted = std::exchange(pops.interrupted, false);
    const planet::Planet& planet = *scene.planet;
    pops.meter.add(planet.tree(), planet.selection(), view, planet.views()[0].input.lod, timeS,
                   {.cameraJumped = cameraJumped || interrupted, .seaM = scene.seaSurfaceM});
}

std::optional<KeptPicture> keptPicture(const planet::ChunkTree& tree, Pops& pops) {
    pops.problem.clear();
    if (!pops.shown || pops.side == PopSide::Live) return std::nullopt;
    const auto frame =
        pops.side == PopSide::Before ? pops.shown->frameBefore.lock() : pops.shown->frameAfter.lock();
    if (!frame) {
        pops.problem =
            "The chunks drawn then are no longer stored; only the latest frames with a level change are.";
        return std::nullopt;
    }
    KeptPicture picture{{}, frame->stitched};
    std::size_t missing = 0;
    for (planet::DrawItem item : frame->items) {
        item.node = planet::findNode(tree, item.id);
        if (item.node == planet::noNode) {
            ++missing;
            continue;
        }
        item.slot = tree.nodes[item.node].slot;
        picture.selection.draw.push_back(item);
    }
    if (missing == 0) return picture;
    pops.problem = fmt::format(
        "{} of the {} chunks drawn then are not resident. Go to the view and wait until they are loaded; "
        "finer levels may need a smaller tolerance.",
        missing, frame->items.size());
    return std::nullopt;
}

const planet::PopEvent* findPop(const Pops& pops, std::uint64_t frame, const planet::ChunkId& chunk) {
    const auto& events = pops.meter.events();
    const auto found = std::find_if(events.begin(), events.end(), [&](const planet::PopEvent& event) {
        return event.frame == frame && event.chunk == chunk;
    });
    return found == events.end() ? nullptr : &*found;
}

}  // namespace worldy
