// Compares two surveys of the same viewpoints. Pure functions, any thread.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "planet/base/result.h"
#include "planet/measure/atlas.h"

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
// Returns whether a value moved farther than the limit; false if either is NaN.
bool isExceeded(const AtlasLimit& limit, double before, double now);

// One viewpoint in which a measure moved.
struct AtlasMove {
    std::size_t viewpoint = 0;  // index in both surveys
    double before = 0;
    double now = 0;

    double by() const { return now - before; }
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

}  // namespace planet
