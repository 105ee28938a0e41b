// The parts of worldy bench. Each measures something of ours beside a plain way to do it, turn about, so that
// a busy machine slows both. Those that draw want a current context.
#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "app/cli/bench_options.h"
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

inline constexpr double loadTimeoutS = 600;  // for all that a view wants

// One line of a table: a quantity of some way to do a thing.
struct BenchRow {
    std::string subject;   // "faces of 513, tau 2 px"
    std::string quantity;  // "frame"
    std::string unit;      // "ms"; empty: a count
    Spread value;
    // How many times the yardstick, round by round; 0 where this is the yardstick, or there is none.
    Spread ratio{};
    std::string yardstick{};  // "every leaf"
};

// Returns of[i] / to[i], round by round.
std::vector<double> ratios(const std::vector<double>& of, const std::vector<double>& to);

struct BenchPlanet {
    int faceSize = 0;                 // samples a side
    std::filesystem::path chunkFile;  // chunks of 33
};

using BenchRows = planet::Result<std::vector<BenchRow>>;

// Runs each job once per round, in order, and returns how long each took, in ms: times[job][round].
std::vector<std::vector<double>> timeInTurn(std::span<const std::function<void()>> jobs, int rounds);

// (a) Frames of LOD at each tau against frames that draw every leaf: time, triangles, memory.
BenchRows benchLodAgainstLeaves(const BenchPlanet& planet, const BenchOptions& options);
// (b) Choosing and drawing against a bare draw of the very same triangles from a static buffer.
BenchRows benchDynamicAgainstStatic(const BenchPlanet& planet, const BenchOptions& options);
// (c) Selection, by visited node and by frame.
BenchRows benchSelection(const BenchPlanet& planet, const BenchOptions& options);
// (d) Paging in what a view wants against reading and decoding the same blocks in a loop.
BenchRows benchPageIn(const BenchPlanet& planet, const BenchOptions& options);
// (e) Baking on one thread against reading the source's samples and packing them with zstd -1.
BenchRows benchBake(const planet::HeightSource& source, int faceSize, const BenchOptions& options,
                    const std::filesystem::path& folder);
// (f) The file, all levels together, against other ways to keep the finest heights alone.
BenchRows benchFileSize(const BenchPlanet& planet, const std::filesystem::path& folder);

// (g) Paging in and uploading every tile of colour, by one loader, against reading and unpacking the same
// blocks in a loop; and what a tile takes. image: none takes made colours.
BenchRows benchColours(const std::filesystem::path& image, const BenchOptions& options,
                       const std::filesystem::path& folder);

}  // namespace worldy
