// The window's pop meter: fed once a frame, gone back to, and flipped between before and after. Wants no GL.
#pragma once

#include <optional>

#include "app/measure/pop_side.h"
#include "app/scene/scene.h"
#include "planet/measure/pop_meter.h"

namespace worldy {

struct Pops {
    planet::PopMeter meter;
    bool measuring = true;
    bool interrupted = false;  // frames went by unmeasured: what they changed is no one frame's switch
    std::optional<planet::PopEvent> shown;  // last gone back to
    PopSide side = PopSide::Live;
    std::string problem;  // why that side cannot be drawn
};

// Another planet: nothing of it is known.
void forgetPops(Pops& pops);

// After a frame has been chosen. View: that shows it. cameraJumped: as of planet::PopConditions.
void measurePops(const Scene& scene, const planet::View& view, double timeS, bool cameraJumped, Pops& pops);

// What is to be drawn instead of what is chosen: the frame before or after the event, its chunks in the slots
// that hold them now. None while the picture is live, or where chunks are missing; then the problem says so.
struct KeptPicture {
    planet::Selection selection;
    bool stitched = false;
};
std::optional<KeptPicture> keptPicture(const planet::ChunkTree& tree, Pops& pops);

// The event, or null if it is no longer kept.
const planet::PopEvent* findPop(const Pops& pops, std::uint64_t frame, const planet::ChunkId& chunk);

}  // namespace worldy
