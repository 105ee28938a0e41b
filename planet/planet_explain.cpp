#include "planet/chunk_explanation.h"

namespace planet {

ChunkExplanation explainChunk(const Planet& planet, const ChunkId& id, std::size_t view) {
    const std::vector<PagingRequest> pageIns = planet.pendingRequests(PagingType::PageIn);
    return explainChunk(StepFacts{planet.tree(), planet.selection(view), planet.lodView(view),
                                  planet.lodSettings(view), pageIns},
                        id);
}

}  // namespace planet
