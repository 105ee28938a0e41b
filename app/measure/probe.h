// The precision probe of the window: at the vertex under the pointer, and at the worst vertex of the selected
// chunk.
#pragma once

#include <optional>

#include "app/measure/probed_vertex.h"
#include "app/scene/scene.h"
#include "planet/measure/pick.h"

namespace worldy {

// Selection 0 and the view that shows it.
struct ProbeInput {
    const planet::ChunkTree& tree;
    const planet::Selection& selection;
    const planet::View& view;
    const planet::gl::Projection& projection;  // projection of the last picture
    bool stitched = false;
};

// Probes the vertex nearest to the hit.
ProbedVertex probeHit(const ProbeInput& input, const planet::SurfaceHit& hit);

// Probes the worst vertex of a chunk. Returns nothing if the chunk is not drawn.
std::optional<ProbedVertex> probeWorst(const ProbeInput& input, const planet::ChunkId& chunk);

}  // namespace worldy
