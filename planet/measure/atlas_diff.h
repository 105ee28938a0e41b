// Compares two surveys of the same viewpoints. Pure functions, any thread.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "planet/base/result.h"
#include "planet/measure/atlas.h"
#include "planet/measure/atlas_sampling.h"

namespace planet {

// How far a measure may move before a check fails: "eps_px=+0.2", "triangles=-10%", "chunks=+0".
struct AtlasLimit {
    std::optional<AtlasMeasure> measure{};  // none: the number of changed chunks
    double by = 0;                          // >= 0, in the measure's unit, or a share of the old value
    bool isShare = false;
    bool isDown = false;  // it limits decreases

    bool operator==(const AtlasLimit&) const = default;
};
// Reads a limit. "error_px" stands for "measured_px". The Error names the text and what is expected.
Result<AtlasLimit> atlasLimitFromText(const std::string& text);
std::string textOf(const AtlasLimit& limit);
// Returns whether a value moved farther than the limit; false if either is NaN. A bound that is lost exceeds any limit.
bool isExceeded(const AtlasLimit& limit, double before, double now);

// One viewpoint in which a measure moved.
struct AtlasMove {
    std::size_t viewpoint = 0;  // index in both surveys
    double before = 0;
    double now = 0;

    double by() const {
        return now == before ? 0 : now - before;
    }  // infinite where a bound was lost or gained
};

// The viewpoints in which one measure is another, sorted by the change: the largest increase first, the largest decrease
// last.
struct AtlasMeasureDiff {
    AtlasMeasure measure = AtlasMeasure::MeasuredPx;
    std::size_t compared = 0;  // viewpoints that have the measure in both surveys
    std::size_t grew = 0;
    std::size_t shrank = 0;
    std::vector<AtlasMove> moves{};
};

// Returns one entry for each measure that any viewpoint has in both. The Error says which viewpoint is not the same.
Result<std::vector<AtlasMeasureDiff>> compareViewpoints(std::span<const AtlasViewpoint> before,
                                                        std::span<const AtlasViewpoint> now);

// Returns the viewpoints of the later survey with AtlasMove::by() as their figures. Both must be the same viewpoints.
std::vector<AtlasViewpoint> changesOf(std::span<const AtlasViewpoint> before,
                                      std::span<const AtlasViewpoint> now);
// Returns which of two changes to show for both, so that an improvement never hides a regression: the larger increase, or
// the larger decrease if neither is an increase. A NaN counts for nothing.
double worseChange(double a, double b);
// Returns the cells that are not split, like cellsOf, with the worse changes over their headings.
std::vector<AtlasCell> changedCellsOf(const AtlasGrid& grid, std::span<const AtlasViewpoint> changes);

}  // namespace planet
