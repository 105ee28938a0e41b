#include "planet/chunk_explanation.h"
#include "planet/planet_tools.h"

namespace planet {

ChunkExplanation explainChunk(const Planet& planet, const ChunkId& id, std::size_t view) {
    const std::vector<PagingRequest> pageIns = planet.inspect().pendingRequests(PagingType::PageIn);
    const PlanetView& step = planet.views()[view];
    return explainChunk(StepFacts{planet.tree(), step.selection, step.input.lodView, step.input.lod, pageIns},
                        id);
}

}  // namespace planet
