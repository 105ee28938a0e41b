// Surveys a planet on several threads.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "planet/measure/atlas.h"
#include "planet/measure/atlas_viewpoint.h"
#include "planet/planet.h"

namespace planet {

// Makes one planet for each thread; called from the thread that surveys, several times.
using OpenAtlasPlanet = std::function<Result<PlanetSource>()>;

struct AtlasProgress {
    std::uint64_t done = 0;   // viewpoints, those of before a resumption included
    std::uint64_t total = 0;  // at most so many
    std::uint64_t since = 0;  // viewpoints measured by this call
    double elapsedS = 0;      // of this call
};

struct AtlasWatch {
    // Called a few times per second by one thread at a time. Returning false cancels.
    std::function<bool(const AtlasProgress&)> goOn;
    // Called with the next viewpoints in their order, at most atlasBatch of them: always as many, except at the end of a
    // round. An Error ends the survey.
    std::function<Result<void>(std::span<const AtlasViewpoint>)> take;
};

struct AtlasRun {
    AtlasCosts costs;            // of all threads together
    double elapsedS = 0;         // of this call
    std::uint64_t measured = 0;  // viewpoints
    std::size_t threads = 0;
};

// Continues a survey after the viewpoints that it has, which it extends. The same viewpoints follow for any number of
// threads, and wherever an earlier call was cancelled. revisited: the places and eyes to measure, if the survey is a
// revisit. The Error names a file and what is wrong, or is of kind Cancelled; the viewpoints taken until then are kept.
Result<AtlasRun> runAtlas(const OpenAtlasPlanet& open, const AtlasSurvey& survey,
                          const AtlasSettings& settings, std::span<const AtlasViewpoint> revisited,
                          std::size_t threads, std::vector<AtlasViewpoint>& viewpoints,
                          const AtlasWatch& watch);

}  // namespace planet
