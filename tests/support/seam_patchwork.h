// A planet whose drawn chunks differ by up to three levels, along edges of chunks and of faces, with random
// morphs; edges filled in by the words of lod_select.h rather than by its code.
#pragma once

#include <algorithm>
#include <map>
#include <random>
#include <span>
#include <vector>

#include "planet/select/lod_select.h"
#include "tests/support/made_heights.h"

namespace planet {

inline double mountains(const glm::dvec3& d) {
    return 9000 * std::sin(31 * d.x + 5) * std::cos(29 * d.y) + 5000 * std::sin(83 * d.z + 41 * d.x) +
           1500 * std::sin(600 * d.y + 500 * d.z + 300 * d.x);
}

// Which chunk is drawn beyond an edge; null where finer ones are.
class Neighbourhood {
public:
    explicit Neighbourhood(std::span<const DrawItem> items) {
        for (const DrawItem& item : items) byId_[item.id] = &item;
    }
    const DrawItem* beyond(const ChunkId& id, Edge edge) const {
        ChunkId other = neighbourOf(id, edge);
        for (;; other = parentOf(other)) {
            const auto found = byId_.find(other);
            if (found != byId_.end()) return found->second;
            if (other.level == 0) return nullptr;
        }
    }

private:
    std::map<ChunkId, const DrawItem*> byId_;
};

// What selection says of the edges, by its header's words.
inline void fillEdges(std::vector<DrawItem>& items) {
    const Neighbourhood neighbourhood(items);
    for (DrawItem& item : items) {
        for (std::size_t edge = 0; edge < edgeCount; ++edge) {
            const DrawItem* other = neighbourhood.beyond(item.id, static_cast<Edge>(edge));
            const int coarser = other == nullptr ? 0 : item.id.level - other->id.level;
            item.coarserBy[edge] = static_cast<std::uint8_t>(coarser);
            item.edgeMorph[edge] = other == nullptr ? item.morph
                                   : coarser == 0   ? std::max(item.morph, other->morph)
                                                    : other->morph;
        }
    }
}

inline PlanetShape smallChunks() {
    PlanetShape shape;
    shape.chunkCellsLog2 = 4;  // three levels apart is the most that they allow
    return shape;
}

inline void addPatch(const ChunkId& id, int depth, std::vector<ChunkId>& ids) {
    if (depth == 0) {
        ids.push_back(id);
        return;
    }
    for (int quadrant = 0; quadrant < quadrantCount; ++quadrant)
        addPatch(childOf(id, quadrant), depth - 1, ids);
}

// The whole planet, each chunk of level 1 cut into 1, 4, 16 or 64, in a pattern that brings all differences
// together along edges of chunks and of faces.
inline std::vector<ChunkId> seamPatchwork() {
    std::vector<ChunkId> ids;
    for (std::uint32_t i = 0; i < 24; ++i) {
        const ChunkId quarter{static_cast<Face>(i / 4), 1, i % 2, i % 4 / 2};
        addPatch(quarter, static_cast<int>((i * 7 + i / 4) % 4), ids);
    }
    return ids;
}

// A fifth of them 0, a fifth 1.
template <class Random>
void morphAtRandom(std::vector<DrawItem>& items, Random& random) {
    std::uniform_real_distribution<float> anyMorph(0, 1);
    for (DrawItem& item : items) {
        const float morph = anyMorph(random);
        item.morph = morph < 0.2f ? 0 : morph > 0.8f ? 1 : morph;
    }
    fillEdges(items);
}

}  // namespace planet
