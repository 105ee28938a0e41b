// Detail below a source's own resolution, as high as the source is rough there.
//
// Roughness is measured on the source's own grid: at each of its samples, the range over it and its eight
// neighbours, over the edges of the cube too (at a corner of the cube, six). Between them it is interpolated
// along both sides of a cell, which on an edge of the cube is the same from both faces.
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "planet/source/terrain_sources.h"

namespace planet {

namespace {

struct Detail {
    HeightSource source;
    DetailTerrain settings;
    std::vector<Octave> octaves;
    double weights = 0;  // sum of the octaves'
    int cells = 0;       // of the source's own grid
};

// Samples of the source's own grid that may reach one step over the edges of their face.
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
        Result<void> done = readPart(detail, face, left, bottom, right, top);
        if (done && firstColumn_ < 0) done = readPart(detail, face, -1, bottom, -1, top);
        if (done && firstColumn_ + columns_ - 1 > cells)
            done = readPart(detail, face, cells + 1, bottom, cells + 1, top);
        if (done && firstRow_ < 0) done = readPart(detail, face, left, -1, right, -1);
        if (done && firstRow_ + rows_ - 1 > cells)
            done = readPart(detail, face, left, cells + 1, right, cells + 1);
        return done;
    }

    // The range around a sample, metres. What lies beyond a corner is not there.
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

    // A rectangle of the face, or over one edge of it.
    Result<void> readPart(const Detail& detail, Face face, int left, int bottom, int right, int top) {
        const FaceGridPoint a = foldedOver({face, left, bottom}, detail.cells);
        const FaceGridPoint b = foldedOver({face, right, top}, detail.cells);
        const SampleTile tile{a.face,
                              detail.cells,
                              std::min(a.column, b.column),
                              std::min(a.row, b.row),
                              std::abs(a.column - b.column) + 1,
                              std::abs(a.row - b.row) + 1};
        std::vector<float> read(static_cast<std::size_t>(tile.columns) * static_cast<std::size_t>(tile.rows));
        if (Result<void> sampled = detail.source.sample(tile, read); !sampled) return sampled;
        for (int row = bottom; row <= top; ++row) {
            for (int column = left; column <= right; ++column) {
                const FaceGridPoint place = foldedOver({face, column, row}, detail.cells);
                heights_[indexOf(column, row)] =
                    read[static_cast<std::size_t>(place.row - tile.firstRow) *
                             static_cast<std::size_t>(tile.columns) +
                         static_cast<std::size_t>(place.column - tile.firstColumn)];
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

// The relief of a tile's cells of the source's own grid, at their corners.
struct Relief {
    int firstColumn = 0;
    int firstRow = 0;
    int columns = 0;
    std::vector<double> valuesM;

    double at(int column, int row) const {
        return valuesM[static_cast<std::size_t>(row - firstRow) * static_cast<std::size_t>(columns) +
                       static_cast<std::size_t>(column - firstColumn)];
    }
    // At a place in steps of the own grid. Each product is exact or alike from both faces of an edge.
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
    if (Result<void> read = grid.read(detail, tile.face); !read) return tl::unexpected(read.error());
    for (int row = relief.firstRow; row <= lastRow; ++row) {
        for (int column = relief.firstColumn; column <= lastColumn; ++column) {
            relief.valuesM.push_back(grid.reliefAt(column, row));
        }
    }
    return relief;
}

// Within about +-the octaves' weights, its mean 0.
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

// The height of a noise of 1, metres.
double heightOfNoise(const Detail& detail, double reliefM, double heightM) {
    const DetailTerrain& s = detail.settings;
    const double rough = smoothly(s.flatM, 3 * s.flatM, reliefM);
    const double dry = smoothly(s.seaM - s.coastM, s.seaM + s.coastM, heightM);
    return std::min(0.5 * s.gain * s.strength * reliefM, s.limitM / detail.weights) * rough * dry;
}

Result<void> sampleTile(const Detail& detail, const SampleTile& tile, std::span<float> out) {
    if (Result<void> sampled = detail.source.sample(tile, out); !sampled) return sampled;
    const std::size_t held = heldBy(detail.octaves, gridStepRad(tile.faceCells));
    if (held == 0 || out.empty()) return {};
    const Result<Relief> relief = reliefOf(detail, tile);
    if (!relief) return tl::unexpected(relief.error());
    const double perStep = static_cast<double>(detail.cells) / tile.faceCells;
    const double limitM = detail.settings.limitM;
    std::size_t at = 0;
    for (int row = tile.firstRow; row < tile.firstRow + tile.rows; ++row) {
        for (int column = tile.firstColumn; column < tile.firstColumn + tile.columns; ++column) {
            const double baseM = static_cast<double>(out[at]);
            const double scaleM =
                heightOfNoise(detail, relief->between(column * perStep, row * perStep), baseM);
            if (scaleM > 0) {
                const glm::dvec3 direction = sphereFromCube(
                    cubePoint(tile.face, 2.0 * column / tile.faceCells - 1, 2.0 * row / tile.faceCells - 1));
                const double addedM = scaleM * noiseAt(detail, held, direction);
                out[at] = static_cast<float>(baseM + std::clamp(addedM, -limitM, limitM));
            }
            ++at;
        }
    }
    return {};
}

}  // namespace

Result<HeightSource> amplified(HeightSource source, const DetailTerrain& detail) {
    if (Result<void> good = checkTerrain(detail); !good) return tl::unexpected(good.error());
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
    shared->source = std::move(source);
    result.sample = [shared = std::shared_ptr<const Detail>(shared)](const SampleTile& tile,
                                                                     std::span<float> out) {
        return sampleTile(*shared, tile, out);
    };
    return result;
}

}  // namespace planet
