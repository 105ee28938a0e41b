// The window's precision probe: at the vertex under the pointer, and at the worst of the selected chunk.
#pragma once

#include <optional>

#include "app/measure/probed_vertex.h"
#include "app/scene/scene.h"
#include "planet/measure/pick.h"

namespace worldy {

// What selection 0 draws, through a view.
struct ProbeInput {
    const planet::ChunkTree& tree;
    const planet::Selection& selection;
    const planet::View& view;
    const planet::gl::Projection& projection;  // that the last picture was drawn with
    bool stitched = false;
};

// The vertex nearest to the hit.
ProbedVertex probeHit(const ProbeInput& input, const planet::SurfaceHit& hit);

// None where the chunk is not drawn.
std::optional<ProbedVertex> probeWorst(const ProbeInput& input, const planet::ChunkId& chunk);

}  // namespace worldy
