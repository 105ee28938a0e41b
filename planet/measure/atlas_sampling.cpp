#include "planet/measure/atlas_sampling.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/trigonometric.hpp>
#include <glm/vec3.hpp>
#include <iterator>
#include <limits>
#include <map>
#include <numbers>
#include <span>
#include <tuple>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "planet/base/percentile.h"
#include "planet/measure/atlas.h"
#include "planet/sphere/chunk_id.h"
#include "planet/sphere/cube_sphere.h"
#include "planet/sphere/view.h"

namespace planet {

namespace {

constexpr double leastScore = 0.02;
constexpr std::size_t splitShare = 8;  // a round splits at most one cell of so many

std::uint64_t cellsOfLevel(int level) {
    return std::uint64_t{faceCount} << (2 * level);
}

void appendPlaces(std::vector<AtlasPlace>& places, const AtlasGrid& grid, const ChunkId& cell, int altitude) {
    for (int heading = 0; heading < grid.headings; ++heading) {
        places.push_back({cell, static_cast<std::uint8_t>(altitude), static_cast<std::uint8_t>(heading)});
    }
}

std::vector<AtlasPlace> firstPlaces(const AtlasGrid& grid) {
    const int level = firstLevelOf(grid);
    std::vector<AtlasPlace> places;
    for (int altitude = 0; altitude < static_cast<int>(grid.altitudesM.size()); ++altitude) {
        for (std::uint64_t i = 0; i < cellsOfLevel(level); ++i)
            appendPlaces(places, grid, chunkInQuadtreeOrder(i, level), altitude);
    }
    return places;
}

// The cells of one altitude that are not split, with the means to find neighbours.
class CellMap {
public:
    explicit CellMap(std::span<const AtlasCell> cells) : cells_(cells) {
        for (std::size_t i = 0; i < cells.size(); ++i) byCell_.emplace(cells[i].cell, i);
    }

    // Calls visit(i, j) for each pair of neighbours.
    void forEachPair(const std::function<void(std::size_t, std::size_t)>& visit) const {
        for (std::size_t i = 0; i < cells_.size(); ++i) {
            for (const Edge edge : allEdges) {
                ChunkId beside = neighbourOf(cells_[i].cell, edge);
                // A neighbour that is split finds this cell itself.
                auto found = byCell_.find(beside);
                while (found == byCell_.end() && beside.level > 0) {
                    beside = parentOf(beside);
                    found = byCell_.find(beside);
                }
                if (found != byCell_.end()) visit(i, found->second);
            }
        }
    }

private:
    std::span<const AtlasCell> cells_;
    std::unordered_map<ChunkId, std::size_t> byCell_;
};

// Returns the values of a measure, NaN where there is none. No bound counts as twice the largest one, so that the edge of
// where there is none is surveyed finely without hiding the other differences.
std::vector<double> valuesToScore(std::size_t measure, std::span<const AtlasCell> cells) {
    std::vector<double> values;
    double largest = 0;
    for (const AtlasCell& cell : cells) {
        values.push_back(cell.values[measure]);
        if (std::isfinite(values.back())) largest = std::max(largest, values.back());
    }
    for (double& value : values) {
        if (std::isinf(value)) value = largest > 0 ? 2 * largest : 1;
    }
    return values;
}

// Raises the scores of all cells by one measure.
void scoreBy(std::size_t measure, std::span<const AtlasCell> cells, const CellMap& map,
             std::vector<double>& scores) {
    const std::vector<double> all = valuesToScore(measure, cells);
    std::vector<double> values;
    std::ranges::copy_if(all, std::back_inserter(values), [](double value) { return !std::isnan(value); });
    if (values.empty()) return;
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    const double range = *most - *least;
    if (!(range > 0)) return;
    const auto raise = [&](std::size_t cell, double by) {
        scores[cell] = std::max(scores[cell], by / range);
    };
    map.forEachPair([&](std::size_t i, std::size_t j) {
        const double difference = std::abs(all[i] - all[j]);
        if (std::isnan(difference)) return;
        raise(i, difference);
        raise(j, difference);
    });
    const double high = percentileOf(std::move(values), 0.99);
    for (std::size_t i = 0; i < cells.size(); ++i) {
        if (all[i] > high) raise(i, all[i] - high);
    }
}

bool maySplit(const AtlasGrid& grid, double radiusM, const AtlasCell& cell) {
    if (cell.cell.level >= grid.finestLevel) return false;
    const double sideM = radiusM * std::numbers::pi / 2 / std::ldexp(1.0, cell.cell.level);
    return sideM > grid.altitudesM[cell.altitude];
}

struct ScoredCell {
    double score = 0;
    std::size_t cell = 0;
};

std::vector<ScoredCell> scoredCells(const AtlasGrid& grid, double radiusM, std::span<const AtlasCell> cells) {
    std::vector<ScoredCell> scored;
    const int firstLevel = firstLevelOf(grid);
    for (std::size_t begin = 0, end = 0; begin < cells.size(); begin = end) {
        while (end < cells.size() && cells[end].altitude == cells[begin].altitude) ++end;
        const auto same = cells.subspan(begin, end - begin);
        const CellMap map(same);
        std::vector<double> scores(same.size());
        for (std::size_t measure = 0; measure < atlasMeasureCount; ++measure)
            scoreBy(measure, same, map, scores);
        for (std::size_t i = 0; i < same.size(); ++i) {
            const double score = scores[i] * std::exp2(-0.5 * (same[i].cell.level - firstLevel));
            if (score >= leastScore && maySplit(grid, radiusM, same[i])) scored.push_back({score, begin + i});
        }
    }
    std::sort(scored.begin(), scored.end(), [](const ScoredCell& a, const ScoredCell& b) {
        return std::tuple(-a.score, a.cell) < std::tuple(-b.score, b.cell);
    });
    return scored;
}

}  // namespace

glm::dvec3 middleOf(const ChunkId& cell) {
    const FaceSquare square = faceSquareOf(cell);
    return sphereFromCube(cubePoint(cell.face, square.u + square.side / 2, square.v + square.side / 2));
}

double atlasBoundPx(double px, double screenScalePx) {
    return px >= screenScalePx ? std::numeric_limits<double>::infinity() : px;
}

double screenScalePx(const AtlasSurvey& survey) {
    return survey.widthPx / (2 * std::tan(0.5 * glm::radians(survey.fovDeg)));
}

CameraPose poseOf(const AtlasSurvey& survey, const AtlasViewpoint& viewpoint) {
    const double dipRad = std::acos(survey.radiusM / (survey.radiusM + std::max(viewpoint.eyeM, 0.0)));
    const Geographic place = geographicFromDirection(middleOf(viewpoint.place.cell));
    return {.latitudeDeg = glm::degrees(place.latitudeRad),
            .longitudeDeg = glm::degrees(place.longitudeRad),
            .altitudeM = viewpoint.eyeM,
            .headingDeg = 360.0 * viewpoint.place.heading / survey.grid.headings,
            .pitchDeg = std::max(survey.grid.pitchDeg - glm::degrees(dipRad), -90.0)};
}

int firstLevelOf(const AtlasGrid& grid) {
    const std::uint64_t ofCell = grid.altitudesM.size() * static_cast<std::uint64_t>(grid.headings);
    int level = grid.coarsestLevel;
    while (level > 0 && 3 * ofCell * cellsOfLevel(level) > grid.most) --level;
    return level;
}

std::vector<AtlasCell> cellsOf(const AtlasGrid& grid, std::span<const AtlasViewpoint> viewpoints) {
    std::map<std::pair<std::uint8_t, ChunkId>, AtlasFigures> found;
    AtlasFigures nothing;
    nothing.fill(std::numeric_limits<double>::quiet_NaN());
    for (const AtlasViewpoint& viewpoint : viewpoints) {
        AtlasFigures& values =
            found.try_emplace({viewpoint.place.altitude, viewpoint.place.cell}, nothing).first->second;
        for (std::size_t i = 0; i < atlasMeasureCount; ++i)
            values[i] = std::fmax(values[i], viewpoint.figures[i]);
    }
    std::vector<std::unordered_set<ChunkId>> split(grid.altitudesM.size());
    for (const auto& [key, values] : found) {
        if (key.second.level > 0) split[key.first].insert(parentOf(key.second));
    }
    std::vector<AtlasCell> cells;
    for (const auto& [key, values] : found) {
        if (!split[key.first].contains(key.second)) cells.push_back({key.second, key.first, values});
    }
    return cells;
}

std::vector<AtlasPlace> nextPlaces(const AtlasGrid& grid, double radiusM,
                                   std::span<const AtlasViewpoint> measured) {
    if (measured.empty()) return firstPlaces(grid);
    const std::vector<AtlasCell> cells = cellsOf(grid, measured);
    const std::uint64_t left = grid.most > measured.size() ? grid.most - measured.size() : 0;
    const std::uint64_t ofSplit = quadrantCount * static_cast<std::uint64_t>(grid.headings);
    std::vector<ScoredCell> scored = scoredCells(grid, radiusM, cells);
    const std::size_t most =
        std::min<std::size_t>(left / ofSplit, std::max<std::size_t>(cells.size() / splitShare, 1));
    scored.resize(std::min(scored.size(), most));
    std::sort(scored.begin(), scored.end(),
              [](const ScoredCell& a, const ScoredCell& b) { return a.cell < b.cell; });
    std::vector<AtlasPlace> places;
    for (const ScoredCell& one : scored) {
        for (int quadrant = 0; quadrant < quadrantCount; ++quadrant)
            appendPlaces(places, grid, childOf(cells[one.cell].cell, quadrant), cells[one.cell].altitude);
    }
    return places;
}

}  // namespace planet
