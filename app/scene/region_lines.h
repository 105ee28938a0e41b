// The outlines of a planet's regions, and the cells of an atlas, over its ground.
#pragma once

#include <glm/vec3.hpp>
#include <memory>
#include <vector>

#include "app/scene/atlas_drape.h"
#include "planet/gl/draw/debug_shapes.h"
#include "planet/tree/chunk_tree.h"

namespace worldy {

// Lines through directions, by region; those of a region that is off are empty.
struct RegionOutlines {
    std::shared_ptr<const planet::RegionSet> of{};  // null: no regions
    std::vector<std::vector<std::vector<glm::dvec3>>> lines{};
};
// Makes the outlines of the tree's regions, if they are others than before.
void follow(RegionOutlines& outlines, const planet::ChunkTree& tree);

// Return the outlines, or those of one region that is being drawn, on the ground, lifted off it by about two pixels. What lies behind the
// horizon is left out.
planet::Lines regionLines(const RegionOutlines& outlines, const planet::ChunkTree& tree,
                          const planet::View& view);
planet::Lines draftLines(const planet::Region& draft, const planet::LineColour& colour,
                         const planet::ChunkTree& tree, const planet::View& view);

// Returns the cells of an atlas in the same way, hatched in their colours.
planet::Lines atlasLines(const AtlasDrape& drape, const planet::ChunkTree& tree, const planet::View& view);

}  // namespace worldy
