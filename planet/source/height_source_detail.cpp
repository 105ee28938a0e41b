// Adds detail below a source's own resolution, in proportion to its local roughness.
//
// Roughness is measured on the source's own grid: it is the range of a sample and its eight neighbours, also
// across the edges of the cube (six at a corner of the cube). Between samples it is interpolated bilinearly,
// which gives the same value on an edge of the cube from both faces.
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "planet/base/try.h"
#include "planet/source/source_parts.h"
#include "planet/source/terrain_sources.h"
#include "planet/source/whole_layer.h"

namespace planet {

namespace {

struct Detail {
    HeightSource source;
    DetailTerrain settings;
    std::vector<Octave> octaves;
    double weights = 0;  // sum of the octaves' weights
    int cells = 0;       // of the source's own grid
};

// Samples of the source's own grid, which may extend one step beyond the edges of their face.
class OwnGrid {
public:
    OwnGrid(int firstColumn, int firstRow, int columns, int rows)
        : firstColumn_(firstColumn),
          firstRow_(firstRow),
          columns_(columns),
          rows_(rows),
          heights_(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows),
                   std::numeric_limits<float>::quiet_NaN()) {}

    Result<void> read(const Detail& detail, Face face) {
        const int cells = detail.cells;
        const int left = std::max(firstColumn_, 0), right = std::min(firstColumn_ + columns_ - 1, cells);
        const int bottom = std::max(firstRow_, 0), top = std::min(firstRow_ + rows_ - 1, cells);
        TRY(readPart(detail, face, left, bottom, right, top));
        for (const int column : {-1, cells + 1}) {
            if (column == std::clamp(column, firstColumn_, firstColumn_ + columns_ - 1))
                TRY(readPart(detail, face, column, bottom, column, top));
        }
        for (const int row : {-1, cells + 1}) {
            if (row == std::clamp(row, firstRow_, firstRow_ + rows_ - 1))
                TRY(readPart(detail, face, left, row, right, row));
        }
        return {};
    }

    // Returns the range around a sample, metres. Samples beyond a corner of the cube do not exist.
    double reliefAt(int column, int row) const {
        float low = std::numeric_limits<float>::infinity();
        float high = -low;
        for (int r = row - 1; r <= row + 1; ++r) {
            for (int c = column - 1; c <= column + 1; ++c) {
                const float height = heights_[indexOf(c, r)];
                if (std::isnan(height)) continue;
                low = std::min(low, height);
                high = std::max(high, height);
            }
        }
        return static_cast<double>(high) - static_cast<double>(low);
    }

private:
    std::size_t indexOf(int column, int row) const {
        return static_cast<std::size_t>(row - firstRow_) * static_cast<std::size_t>(columns_) +
               static_cast<std::size_t>(column - firstColumn_);
    }

    // Reads a rectangle on the face, or beyond one of its edges.
    Result<void> readPart(const Detail& detail, Face face, int left, int bottom, int right, int top) {
        const SampleTile tile = tileBetween(foldedOver({face, left, bottom}, detail.cells),
                                            foldedOver({face, right, top}, detail.cells), detail.cells);
        std::vector<float> read(samplesIn(tile));
        TRY(detail.source.sample(tile, read));
        for (int row = bottom; row <= top; ++row) {
            for (int column = left; column <= right; ++column) {
                const FaceGridPoint place = foldedOver({face, column, row}, detail.cells);
                heights_[indexOf(column, row)] = read[indexIn(tile, place.column, place.row)];
            }
        }
        return {};
    }

    int firstColumn_;
    int firstRow_;
    int columns_;
    int rows_;
    std::vector<float> heights_;
};

// The relief at the corners of a tile's cells of the source's own grid.
struct Relief {
    int firstColumn = 0;
    int firstRow = 0;
    int columns = 0;
    std::vector<double> valuesM;

    double at(int column, int row) const {
        return valuesM[static_cast<std::size_t>(row - firstRow) * static_cast<std::size_t>(columns) +
                       static_cast<std::size_t>(column - firstColumn)];
    }
    // Returns the relief at a place in steps of the own grid. Each product is exact, or the same from both
    // faces of an edge.
    double between(double column, double row) const {
        const int c = static_cast<int>(column), r = static_cast<int>(row);
        const double s = column - c, t = row - r;
        const int nextC = s > 0 ? c + 1 : c, nextR = t > 0 ? r + 1 : r;
        const double below = at(c, r) * (1 - s) + at(nextC, r) * s;
        const double above = at(c, nextR) * (1 - s) + at(nextC, nextR) * s;
        return below * (1 - t) + above * t;
    }
};

Result<Relief> reliefOf(const Detail& detail, const SampleTile& tile) {
    const double perStep = static_cast<double>(detail.cells) / tile.faceCells;
    const auto first = [&](int sample) { return static_cast<int>(std::floor(sample * perStep)); };
    const auto last = [&](int sample) { return static_cast<int>(std::ceil(sample * perStep)); };
    Relief relief{first(tile.firstColumn), first(tile.firstRow), 0, {}};
    const int lastColumn = last(tile.firstColumn + tile.columns - 1);
    const int lastRow = last(tile.firstRow + tile.rows - 1);
    relief.columns = lastColumn - relief.firstColumn + 1;
    OwnGrid grid(relief.firstColumn - 1, relief.firstRow - 1, relief.columns + 2,
                 lastRow - relief.firstRow + 3);
    TRY(grid.read(detail, tile.face));
    for (int row = relief.firstRow; row <= lastRow; ++row) {
        for (int column = relief.firstColumn; column <= lastColumn; ++column) {
            relief.valuesM.push_back(grid.reliefAt(column, row));
        }
    }
    return relief;
}

// Returns noise with mean 0, within about +-the sum of the octaves' weights.
double noiseAt(const Detail& detail, std::size_t held, const glm::dvec3& direction) {
    double sum = 0;
    for (std::size_t i = 0; i < held; ++i) {
        const Octave& octave = detail.octaves[i];
        const double noise = noiseOf(octave, direction);
        const double edge = std::max(0.0, 1 - std::abs(noise));
        const double ridge = 1.5 * (edge * edge - meanRidge);
        sum += octave.weight * (noise + detail.settings.ridged * (ridge - noise));
    }
    return sum;
}

// Returns the height that a noise value of 1 stands for, metres.
double heightOfNoise(const Detail& detail, double reliefM, double heightM) {
    const DetailTerrain& s = detail.settings;
    const double rough = smoothly(s.flatM, 3 * s.flatM, reliefM);
    const double dry = smoothly(s.seaM - s.coastM, s.seaM + s.coastM, heightM);
    return std::min(0.5 * s.gain * s.strength * reliefM, s.limitM / detail.weights) * rough * dry;
}

Result<void> sampleTile(const Detail& detail, const SampleTile& tile, std::span<float> out) {
    TRY(detail.source.sample(tile, out));
    const std::size_t held = heldBy(detail.octaves, gridStepRad(filterCellsOf(tile)));
    if (held == 0 || out.empty()) return {};
    TRY_ASSIGN(const auto relief, reliefOf(detail, tile));
    const double perStep = static_cast<double>(detail.cells) / tile.faceCells;
    const double limitM = detail.settings.limitM;
    std::size_t at = 0;
    for (int row = tile.firstRow; row < tile.firstRow + tile.rows; ++row) {
        for (int column = tile.firstColumn; column < tile.firstColumn + tile.columns; ++column) {
            const double baseM = static_cast<double>(out[at]);
            const double scaleM =
                heightOfNoise(detail, relief.between(column * perStep, row * perStep), baseM);
            if (scaleM > 0) {
                const glm::dvec3 direction = directionOf(tile.face, tile.faceCells, column, row);
                const double addedM = scaleM * noiseAt(detail, held, direction);
                out[at] = static_cast<float>(baseM + std::clamp(addedM, -limitM, limitM));
            }
            ++at;
        }
    }
    return {};
}

// Returns the layers under the detail, with the detail on top.
std::shared_ptr<const SourceLayers> withDetail(const SourceLayers& below, const HeightSource& refined) {
    auto layers = std::make_shared<SourceLayers>(below);
    SourceLayer detail = wholeLayer(refined, LayerKind::Detail, 0);
    detail.name = "detail";
    detail.sampleCount = detail.missingCount = 0;
    layers->layers.push_back(std::move(detail));
    layers->at = [under = below.at, sample = refined.sample, size = refined.naturalFaceSize,
                  layer = layers->layers.size() -
                          1](const Geographic& place) -> Result<std::vector<SourceReading>> {
        TRY_ASSIGN(auto readings, under(place));
        TRY_ASSIGN(auto top, readGridPoint(sample, size, place));
        top.layer = layer;
        readings.insert(readings.begin(), std::move(top));
        return readings;
    };
    return layers;
}

}  // namespace

Result<HeightSource> amplified(HeightSource source, const DetailTerrain& detail) {
    TRY(checkTerrain(detail));
    auto shared = std::make_shared<Detail>();
    shared->settings = detail;
    shared->cells = powerOfTwoCells(source.naturalFaceSize - 1);
    shared->octaves =
        octavesOf(detail.seed, detail.octaves, gridStepRad(shared->cells), detail.lacunarity, detail.gain);
    for (const Octave& octave : shared->octaves) shared->weights += octave.weight;
    const double finestCells = std::numbers::pi / shared->octaves.back().cellRad;

    HeightSource result;
    result.description = terrainText({detail, source.description});
    result.naturalFaceSize =
        std::min(powerOfTwoCells(finestCells * (1 - 1e-9)), powerOfTwoCells(4.0 * shared->cells)) + 1;
    result.minM = source.minM - detail.limitM;
    result.maxM = source.maxM + detail.limitM;
    result.sampleCount = source.sampleCount;
    result.missingCount = source.missingCount;
    result.memoryBytes = source.memoryBytes;
    result.reads = source.reads;
    if (source.parts) {
        const std::uint64_t hash = Fingerprint()
                                       .add(terrainText({detail, {}}))
                                       .add(std::int32_t{shared->cells})
                                       .add(source.minM)
                                       .add(source.maxM)
                                       .hash();
        // The relief of a place is that of the samples around its cell of the source's own grid.
        const double reachRad = 8.0 / shared->cells;
        // The source is sampled on that grid too.
        const double ownSpacingRad = std::numbers::pi / 2 / shared->cells;
        result.parts = [of = source.parts, hash, reachRad,
                        ownSpacingRad](double filterSpacingRad) -> Result<std::vector<SourcePart>> {
            TRY_ASSIGN(auto parts, of(std::max(filterSpacingRad, ownSpacingRad)));
            for (SourcePart& part : parts)
                part.radiusRad = std::min(part.radiusRad + reachRad, std::numbers::pi);
            parts.push_back(wholePlanet(hash, {}));
            return parts;
        };
    }
    if (source.finestCells) {
        // Detail refines the finest parts of a source. Elsewhere its octaves are too small to show.
        result.finestCells = [of = source.finestCells, finest = shared->cells,
                              refined = result.naturalFaceSize - 1](const ChunkId& square) {
            const int cells = of(square);
            return cells < finest ? cells : refined;
        };
    }
    // Detail needs no finer quantum than what it refines.
    result.finestQuantumM = source.finestQuantumM;
    if (source.sampleWithQuanta) {
        result.sampleWithQuanta = [shared](const SampleTile& tile, double radiusM, std::span<float> out,
                                           std::span<float> neededM) -> Result<void> {
            TRY(shared->source.sampleWithQuanta(tile, radiusM, out, neededM));
            return sampleTile(*shared, tile, out);
        };
    }
    const std::shared_ptr<const SourceLayers> below = source.layers;
    shared->source = std::move(source);
    result.sample = [shared = std::shared_ptr<const Detail>(shared)](const SampleTile& tile,
                                                                     std::span<float> out) {
        return sampleTile(*shared, tile, out);
    };
    if (below) result.layers = withDetail(*below, result);
    return result;
}

}  // namespace planet
