// The parts of worldy bench. Each measures an implementation of Worldy against a plain one in alternation, so
// that other load slows both. Those that draw need a current context.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/bench/bench_options.h"
#include "planet/base/result.h"
#include "planet/source/height_source.h"

namespace worldy {

// The spread of a quantity over the rounds.
struct Spread {
    double median = 0;
    double minimum = 0;
    double maximum = 0;
};
// Returns the spread of at least one value. The median of an even number is the lower middle one.
Spread spreadOf(std::vector<double> values);

inline constexpr double loadTimeoutS = 600;  // for all blocks of a view

// The bound that the developers want a figure to keep. The bound of a value is meant for their own machine.
struct BenchAim {
    double bound = 0;
    bool isUpperBound = true;
    bool isOfRatio = false;  // to the yardstick
};

// One row of a table: a quantity of one implementation.
struct BenchRow {
    std::string subject;   // "faces of 513, tau 2 px"
    std::string quantity;  // "frame"
    std::string unit;      // "ms"; empty: a count
    Spread value;
    // The value relative to the baseline, per round; 0 if this is the baseline or there is none.
    Spread ratio{};
    std::string yardstick{};  // "every leaf"
    std::optional<BenchAim> aim{};
};

// Returns of[i] / to[i], round by round.
std::vector<double> ratios(const std::vector<double>& of, const std::vector<double>& to);

struct BenchPlanet {
    int faceSize = 0;                 // samples per side
    std::filesystem::path chunkFile;  // with chunks of 33
};

using BenchRows = planet::Result<std::vector<BenchRow>>;

// Runs each job once per round, in order, and returns how long each took, in ms: times[job][round].
std::vector<std::vector<double>> timeInTurn(std::span<const std::function<void()>> jobs, int rounds);

// (a) Measures LOD frames at each tau against frames that draw every leaf: time, triangles, memory.
BenchRows benchLodAgainstLeaves(const BenchPlanet& planet, const BenchOptions& options);
// (b) Measures selecting and drawing against one draw of the same triangles from a static buffer, with the same fragment
// shader.
BenchRows benchDynamicAgainstStatic(const BenchPlanet& planet, const BenchOptions& options);
// (j) Measures frames with everything and with less against a plain mesh that morphs and has skirts and one texture, in a
// picture of the size asked for and in a small one. One frame draws the colours of the planet's file, as a first start does; the others draw
// the image. colourImage empty: a colour ramp by height.
BenchRows benchFrame(const BenchPlanet& planet, const planet::HeightSource& source,
                     const std::filesystem::path& colourImage, const BenchOptions& options,
                     const std::filesystem::path& folder);
// (c) Measures selection, per visited node and per frame.
BenchRows benchSelection(const BenchPlanet& planet, const BenchOptions& options);
// (d) Measures paging in the blocks of a view, with one loader and with two, against reading and decoding the same blocks in a
// loop, and measures a loop that keeps them.
BenchRows benchPageIn(const BenchPlanet& planet, const BenchOptions& options);
// (e) Measures baking on one thread against reading the source's samples and packing them with zstd -1.
BenchRows benchBake(const planet::HeightSource& source, int faceSize, const BenchOptions& options,
                    const std::filesystem::path& folder);
// (f) Measures verifying the heights of a file on all threads against one thread.
BenchRows benchVerify(const BenchPlanet& planet, const BenchOptions& options);
// (g) Compares the size of the file with all levels with other formats for the finest heights alone. Of the Earth that comes
// with Worldy, it also codes four rasters on their own grids at each compression level, and decodes them on one core.
BenchRows benchFileSize(const BenchPlanet& planet, const BenchOptions& options,
                        const std::filesystem::path& folder);

// (h) Measures paging in and uploading every colour tile with one loader against reading and unpacking the
// same blocks in a loop, and the memory per tile. image empty: synthetic colours.
BenchRows benchColours(const std::filesystem::path& image, const BenchOptions& options,
                       const std::filesystem::path& folder);

// (i) Measures the program from its start to its end: commands that draw nothing, and one that draws a picture.
BenchRows benchStart(const BenchPlanet& planet, const BenchOptions& options,
                     const std::filesystem::path& folder);

}  // namespace worldy
