// The tables and reports of an atlas, and of its difference from another. Pure functions, any thread.
#pragma once

#include <array>
#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <vector>

#include "planet/measure/atlas.h"
#include "planet/measure/atlas_diff.h"
#include "planet/measure/atlas_run.h"
#include "planet/measure/atlas_tree.h"

namespace worldy {

// The distribution of one measure over the viewpoints that have it, by nearest rank. No bound is larger than any number.
struct AtlasSpread {
    planet::AtlasMeasure measure = planet::AtlasMeasure::MeasuredPx;
    std::size_t count = 0;
    std::size_t unbounded = 0;  // viewpoints without a bound, of those counted
    double median = 0;
    double p90 = 0;
    double p99 = 0;
    double most = 0;
};
// Returns those of the measures that any viewpoint has.
std::vector<AtlasSpread> spreadsOf(std::span<const planet::AtlasViewpoint> viewpoints);

// Returns the indices of the viewpoints with the largest values of a measure, the largest first, at most count of them.
// From each cell and altitude, only the worst heading is taken.
std::vector<std::size_t> worstViewpoints(std::span<const planet::AtlasViewpoint> viewpoints,
                                         planet::AtlasMeasure measure, std::size_t count);

// Returns a value with its unit: "1.24 px", "0.35 s", "1.2 MiB", "184 k"; "no bound" for infinity.
std::string figureText(planet::AtlasMeasure measure, double value);
// Returns a change with its unit: "+1.24 px", "-0.35 s", "0"; "bound lost" and "bound gained" for infinity.
std::string changeText(planet::AtlasMeasure measure, double by);
// Returns "46.5 N 7.9 E, 200 m, 90°": the place, the altitude above the ground and the heading.
std::string viewpointText(const planet::AtlasSurvey& survey, const planet::AtlasViewpoint& viewpoint);

// Returns one line per viewpoint below a line of names.
std::string atlasCsv(const planet::Atlas& atlas);
// Returns all viewpoints with the spreads. run: its figures are left out if nothing was measured.
nlohmann::ordered_json atlasJson(const planet::Atlas& atlas, const planet::AtlasRun& run, double treeS);

// Says whether a limit was met, and where it was not.
struct AtlasVerdict {
    planet::AtlasLimit limit;
    std::vector<planet::AtlasMove> exceeded;  // the worst first; empty for the number of chunks
    bool isMet = true;
};

struct AtlasDiff {
    std::vector<planet::AtlasMeasureDiff> measures;
    std::vector<planet::AtlasChunkChange> chunks;
    std::vector<planet::AtlasChangedArea> areas;
    bool comparesTrees = false;  // both atlases have a tree
    std::vector<AtlasVerdict> verdicts;

    bool isWithinLimits() const;
};
// Compares an atlas with a later survey of the same viewpoints. The Error names a limit whose measure one of them lacks.
planet::Result<AtlasDiff> diffOf(const planet::Atlas& before, const planet::Atlas& now,
                                 std::span<const planet::AtlasLimit> limits);

// Returns the differences and the verdicts. worst: viewpoints, areas and chunks to list of each.
nlohmann::ordered_json diffJson(const AtlasDiff& diff, const planet::Atlas& now, std::size_t worst);

}  // namespace worldy
