#include "planet/source/terrain_sources.h"

#include "planet/base/try.h"
#include "planet/source/whole_layer.h"

namespace planet {

int naturalCells(double stepRad) {
    if (!(stepRad > 0)) return mostNaturalCells;
    const double cells = std::numbers::pi / 2 / stepRad;
    return powerOfTwoCells(std::clamp(cells, double{leastNaturalCells}, double{mostNaturalCells}));
}

std::vector<Octave> octavesOf(std::uint32_t seed, int count, double firstCellRad, double lacunarity,
                              double gain) {
    std::vector<Octave> octaves;
    double cellRad = firstCellRad;
    double weight = 1;
    for (int i = 0; i < count; ++i) {
        const std::uint64_t hash = scrambled64((std::uint64_t{seed} << 8) + static_cast<std::uint64_t>(i));
        const auto shiftBy = [&](std::uint64_t axis) { return 256 * unitOf(scrambled64(hash + axis)); };
        octaves.push_back({1 / cellRad,
                           cellRad,
                           weight,
                           static_cast<std::uint32_t>(hash),
                           {shiftBy(1), shiftBy(2), shiftBy(3)}});
        cellRad /= lacunarity;
        weight *= gain;
    }
    return octaves;
}

std::size_t heldBy(std::span<const Octave> octaves, double stepRad) {
    std::size_t count = 0;
    // Lattice cells are often exactly two steps of a grid wide, except for rounding.
    while (count < octaves.size() && octaves[count].cellRad * (1 + 1e-9) >= 2 * stepRad) ++count;
    return count;
}

Result<HeightSource> makeTerrain(const TerrainSettings& settings) {
    TRY(checkTerrain(settings));
    struct Make {
        Result<HeightSource> operator()(const FractalTerrain& t) const { return fractalSource(t); }
        Result<HeightSource> operator()(const RidgedTerrain& t) const { return ridgedSource(t); }
        Result<HeightSource> operator()(const FaultTerrain& t) const { return faultSource(t); }
        Result<HeightSource> operator()(const MidpointTerrain& t) const { return midpointSource(t); }
        Result<HeightSource> operator()(const CraterTerrain& t) const { return craterSource(t); }
        Result<HeightSource> operator()(const DetailTerrain&) const {
            return badInput("detail is added to a source; expected detail:of=PATH");
        }
    };
    Result<HeightSource> source = std::visit(Make{}, settings);
    if (!source) return source;
    source->layers = singleLayer(wholeLayer(*source, LayerKind::Terrain, 0),
                                 [sample = source->sample, size = source->naturalFaceSize](
                                     const Geographic& place) { return readGridPoint(sample, size, place); });
    return source;
}

}  // namespace planet
