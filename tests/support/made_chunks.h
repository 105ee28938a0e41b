// The chunks of a planet of any size, each made from a formula when it is asked for: heights alone, without
// true errors.
#pragma once

#include <array>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include "planet/paging/finest_heights.h"
#include "planet/paging/pager.h"
#include "planet/planet.h"

namespace planet::test {

struct MadeChunks {
    PlanetShape shape;
    std::function<double(const glm::dvec3& direction)> heightM;
    // Bounds that hold of every formula.
    static constexpr std::int32_t lowest = std::numeric_limits<std::int16_t>::min();
    static constexpr std::int32_t highest = std::numeric_limits<std::int16_t>::max();
    std::optional<ChunkId> broken;  // whose block of children cannot be read
    ErrorKind brokenBy = ErrorKind::BadInput;

    MadeChunks(const PlanetShape& planetShape, std::function<double(const glm::dvec3&)> height)
        : shape(planetShape), heightM(std::move(height)) {}

    // Returns the step of a vertex of a face with so many cells along each side.
    std::int16_t step(Face face, int column, int row, int cells) const;

    ChunkData chunk(const ChunkId& id) const;

    Result<SiblingBlock> children(const ChunkId& parent) const {
        if (parent == broken) {
            const std::string message = "made.chk: the block of chunk " + toString(parent) + " is damaged";
            return tl::unexpected(Error{brokenBy, message});
        }
        SiblingBlock block;
        for (int q = 0; q < quadrantCount; ++q)
            block[static_cast<std::size_t>(q)] = chunk(childOf(parent, q));
        return block;
    }

    // This must outlive them.
    LoadChildren loader() const {
        return [this](const ChunkId& parent, BlockLocation, StepsView) { return children(parent); };
    }
    std::array<HeldChunk, faceCount> roots() const {
        std::array<HeldChunk, faceCount> held;
        for (const Face face : allFaces) {
            ChunkData root = chunk({face, 0, 0, 0});
            held[static_cast<std::size_t>(face)] = {
                root.id, std::make_shared<const Steps>(std::move(root.heights)), root.children};
        }
        return held;
    }
    PlanetSource source() const {
        PlanetSource made;
        made.shape = shape;
        made.minStep = lowest;
        made.maxStep = highest;
        for (const Face face : allFaces) made.roots[static_cast<std::size_t>(face)] = chunk({face, 0, 0, 0});
        made.loadChildren = loader();
        return made;
    }
};

}  // namespace planet::test
