#include "planet/bake/job/job_units.h"

#include <algorithm>

namespace planet {

int jobUnitLevels(const PlanetShape& shape, std::uint64_t leafCells, int tileLevels) {
    const std::uint64_t cellsOfTile = chunkCellCount(shape) << (2 * tileLevels);
    int levels = 0;
    while (levels < shape.chunkCellsLog2 && (cellsOfTile << (2 * (levels + 1))) <= leafCells / wantedJobUnits)
        ++levels;
    return levels;
}

std::vector<ChunkId> jobUnits(const HeightSource& source, const PlanetShape& shape, int tileLevels,
                              int unitLevels) {
    std::vector<ChunkId> units;
    std::vector<ChunkId> open;  // the next one last
    for (auto face = allFaces.rbegin(); face != allFaces.rend(); ++face) open.push_back({*face, 0, 0, 0});
    while (!open.empty()) {
        const ChunkId id = open.back();
        open.pop_back();
        if (!unitsUnder(source, shape, id, tileLevels, unitLevels).empty()) {
            units.push_back(id);
            continue;
        }
        for (int q = quadrantCount - 1; q >= 0; --q) open.push_back(childOf(id, q));
    }
    return units;
}

std::vector<ColourUnit> colourUnits(const ColourTree& tree) {
    std::vector<ColourUnit> units;
    for (std::size_t level = tree.levels.size(); level-- > 0;) {
        const std::size_t count = tree.levels[level].ids.size();
        const std::size_t most = colourBlocksInUnit * colourTilesInBlock(level);
        for (std::size_t first = 0; first < count; first += most)
            units.push_back({level, first, std::min(most, count - first)});
    }
    return units;
}

}  // namespace planet
