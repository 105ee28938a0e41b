// The pop meter of the window: measures each frame, and shows the frames before and after a pop again. Needs
// no GL.
#pragma once

#include <optional>

#include "app/measure/pop_side.h"
#include "app/scene/scene.h"
#include "planet/measure/pop_meter.h"

namespace worldy {

struct Pops {
    planet::PopMeter meter;
    bool measuring = true;
    bool interrupted = false;  // frames were not measured, so their changes belong to no single frame
    std::optional<planet::PopEvent> shown;  // the pop that the view last went to
    PopSide side = PopSide::Live;
    std::string problem;  // why the side cannot be drawn
};

// Discards all pops. Call it when another planet is shown.
void forgetPops(Pops& pops);

// Measures the pops of a frame after its selection. view shows the frame; for cameraJumped see
// planet::PopConditions.
void measurePops(const Scene& scene, const planet::View& view, double timeS, bool cameraJumped, Pops& pops);

// The frame before or after a pop, to draw instead of the live selection, with the current slots of its
// chunks.
struct KeptPicture {
    planet::Selection selection;
    bool stitched = false;
};
// Returns nothing while the picture is live, or if chunks are missing; then pops.problem is set.
std::optional<KeptPicture> keptPicture(const planet::ChunkTree& tree, Pops& pops);

// Returns the event, or null if it is no longer stored.
const planet::PopEvent* findPop(const Pops& pops, std::uint64_t frame, const planet::ChunkId& chunk);

}  // namespace worldy
